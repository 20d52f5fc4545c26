# Reliability, the 2 x 2 design and mixed logistic models. Writes expected/models.json.
# Rscript tests/analysis/r/models.R   (Debian: r-base-core r-recommended r-cran-lme4 r-cran-psych r-cran-jsonlite)
suppressPackageStartupMessages({library(lme4); library(psych); library(jsonlite)})
here <- dirname(sub("--file=", "", grep("--file=", commandArgs(FALSE), value = TRUE)))
set.seed(7)

# Reliability: whole answers of 1 to 5 that share a factor, with missing cells, with a constant item, with two items.
answers <- function(n, loadings) {
  f <- rnorm(n)
  sapply(loadings, function(l) pmin(5, pmax(1, round(3 + 1.1 * (l * f + sqrt(1 - l^2) * rnorm(n))))))
}
holes <- answers(40, c(.7, .6, .8, .5)); holes[cbind(c(2, 9, 9, 31), c(1, 3, 4, 2))] <- NA
scales <- list(
  four = answers(56, c(.8, .7, .75, .6)),
  with_missing = holes,
  six = answers(200, c(.4, .5, .6, .7, .8, .3)),
  against = { a <- answers(30, c(.7, .7, .6)); a[, 3] <- 6 - a[, 3]; a },
  constant_item = cbind(answers(20, c(.7, .7, .6)), 3),
  two_items = answers(25, c(.8, .8)))
omega <- function(m) {
  if (ncol(m) < 3 || any(apply(m, 2, sd) == 0)) return(NULL)
  k <- ncol(m); r <- cor(m)
  fit <- factanal(m, 1)
  if (any(fit$uniquenesses < .00501)) return("Heywood")
  # factanal stops early: brought to full precision by Newton steps on its own gradient.
  loadings <- function(psi) { e <- eigen(r / sqrt(outer(psi, psi)), TRUE); sqrt(psi) * e$vectors[, 1] * sqrt(e$values[1] - 1) }
  slope <- function(psi) (loadings(psi)^2 + psi - 1) / psi^2
  psi <- unname(fit$uniquenesses)
  for (step in 1:8) {
    h <- 1e-5; jacobian <- sapply(1:k, function(i) { e <- replace(numeric(k), i, h); (slope(psi + e) - slope(psi - e)) / (2 * h) })
    psi <- psi - solve(jacobian, slope(psi))
  }
  stopifnot(max(abs(fit$uniquenesses - psi)) < 1e-3, max(abs(slope(psi))) < 1e-10)
  s <- apply(m, 2, sd); l <- loadings(psi)
  sum(l * s)^2 / (sum(l * s)^2 + sum(psi * s^2))
}
reliable <- lapply(scales, function(m) {
  c0 <- m[complete.cases(m), , drop = FALSE]; n <- nrow(c0); k <- ncol(c0)
  a <- suppressWarnings(psych::alpha(c0, check.keys = FALSE, warnings = FALSE))
  value <- if (any(apply(c0, 2, sd) == 0)) k / (k - 1) * (1 - sum(apply(c0, 2, var)) / var(rowSums(c0))) else a$total$raw_alpha
  f <- qf(c(.975, .025), n - 1, (n - 1) * (k - 1))
  list(items = m, n = n, alpha = c(value, 1 - (1 - value) * f), omega = omega(c0),
    item_rest = suppressWarnings(sapply(1:k, function(i) cor(c0[, i], rowSums(c0[, -i, drop = FALSE])))))
})

# 2 x 2, unequal cells, sums of squares of type III by sum contrasts.
options(contrasts = c("contr.sum", "contr.poly"))
cells <- function(n, mean, sd) list(
  value = unlist(mapply(function(n, m, s) round(rnorm(n, m, s), 3), n, mean, sd, SIMPLIFY = FALSE)),
  first = rep(c(0, 0, 1, 1), n), second = rep(c(0, 1, 0, 1), n))
designs <- list(
  equal = cells(c(44, 44, 44, 44), c(58, 57, 53, 51), c(13, 12, 8, 8)),
  unequal = cells(c(4, 19, 8, 31), c(10, 12, 11, 9), c(2, 2, 5, 1)),
  tiny = list(value = c(1, 1, 2, 5, 5, 6, 5, 2, 2, 3, 9, 9, 2), first = rep(c(0, 0, 1, 1), c(3, 4, 3, 3)), second = rep(c(0, 1, 0, 1), c(3, 4, 3, 3))))
factorial <- lapply(designs, function(d) {
  fit <- lm(value ~ factor(first) * factor(second), d)
  table <- drop1(fit, . ~ ., test = "F"); rss <- deviance(fit)
  c(d, list(f = table[2:4, "F value"], p = table[2:4, "Pr(>F)"], df = df.residual(fit),
            eta = table[2:4, "Sum of Sq"] / (table[2:4, "Sum of Sq"] + rss)))
})

# Mixed logistic models: lme4 with 25 nodes, then brought to full precision on the integral itself.
# The integral over the intercept by the trapezoidal rule on a fine grid, which for such a smooth hump is exact.
grid <- seq(-14, 14, by = .04)
marginal <- function(par, d, x) {
  beta <- par[-length(par)]; eta <- drop(x %*% beta)
  inside <- outer(eta, par[length(par)] * grid, "+")
  joint <- rowsum(d$hits * inside - d$trials * log1p(exp(inside)), d$person)
  joint <- sweep(joint, 2, dnorm(grid, log = TRUE), "+"); top <- apply(joint, 1, max)
  sum(top + log(rowSums(exp(joint - top)) * .04))
}
gradient <- function(f, par, h = 2e-3) sapply(seq_along(par), function(k) {
  step <- function(s) { e <- replace(numeric(length(par)), k, s); (f(par + e) - f(par - e)) / (2 * s) }
  d <- c(step(h), step(h / 2), step(h / 4)); one <- (4 * d[2:3] - d[1:2]) / 3; (16 * one[2] - one[1]) / 15
})
curvature <- function(f, par, h = 2e-2) {
  k <- length(par); m <- matrix(0, k, k)
  second <- function(i, j, h) { a <- replace(numeric(k), i, h); b <- replace(numeric(k), j, h)
    if (i == j) (f(par + a) - 2 * f(par) + f(par - a)) / h^2 else (f(par + a + b) - f(par + a - b) - f(par - a + b) + f(par - a - b)) / (4 * h^2) }
  for (i in 1:k) for (j in i:k) {
    d <- c(second(i, j, h), second(i, j, h / 2), second(i, j, h / 4)); one <- (4 * d[2:3] - d[1:2]) / 3
    m[i, j] <- m[j, i] <- (16 * one[2] - one[1]) / 15 }
  m
}
exactly <- function(d, x, start) {
  f <- function(par) -marginal(par, d, x)
  par <- nlm(f, start, gradtol = 1e-8)$estimate
  h <- curvature(f, par)
  for (k in 1:6) { step <- solve(h, gradient(f, par)); par <- par - step; if (max(abs(step)) < 1e-9) break; if (k == 2) h <- curvature(f, par) }
  list(par = par, value = -f(par), errors = sqrt(diag(solve(curvature(f, par)))))
}
simulate <- function(people, trials, beta, sd, covariate = NULL) {
  person <- rep(seq_len(people), each = if (is.null(covariate)) 1 else 2); condition <- (person - 1) %% 2
  b <- rnorm(people, 0, sd)[person]; n <- if (length(trials) > 1) sample(trials, length(person), TRUE) else rep(trials, length(person))
  extra <- if (is.null(covariate)) NULL else rep(0:1, people)
  eta <- beta[1] + beta[2] * condition + (if (is.null(extra)) 0 else beta[3] * extra) + b
  list(hits = rbinom(length(person), n, plogis(eta)), trials = n, person = person, condition = condition, extra = extra)
}
sets <- list(
  followed = simulate(56, 3:14, c(1.6, .7), .9),
  few_trials = simulate(60, 1:3, c(.2, .6), 1.2),
  with_covariate = simulate(40, 4:20, c(-.8, .4, .9), .7, TRUE),
  no_spread = { d <- simulate(40, 6, c(.3, .5), 0); d$hits <- rep(c(3, 4), length.out = 40); d$hits[1:4] <- c(4, 3, 2, 5); d })
mixed <- lapply(sets, function(d) {
  frame <- data.frame(hits = d$hits, trials = d$trials, person = factor(d$person), condition = d$condition)
  if (!is.null(d$extra)) frame$extra <- d$extra
  fixed <- if (is.null(d$extra)) ~ condition else ~ condition + extra
  x <- model.matrix(fixed, frame)
  plain <- glm(update(fixed, cbind(hits, trials - hits) ~ .), binomial, frame, control = glm.control(1e-14, 100))
  fit <- suppressMessages(suppressWarnings(glmer(update(fixed, cbind(hits, trials - hits) ~ . + (1 | person)), frame, binomial, nAGQ = 25)))
  log_lik <- function(m, x) { eta <- drop(x %*% coef(m)); sum(d$hits * eta - d$trials * log1p(exp(eta))) }
  if (getME(fit, "theta") < 1e-3) {
    chi <- sapply(2:ncol(x), function(k) { less <- glm(cbind(d$hits, d$trials - d$hits) ~ x[, -k] - 1, binomial, control = glm.control(1e-14, 100)); less$deviance - plain$deviance })
    return(c(d, list(boundary = TRUE, sd = 0, beta = unname(coef(plain)), errors = unname(sqrt(diag(vcov(plain)))),
      log_likelihood = log_lik(plain, x), chi = chi, p = pchisq(chi, 1, lower.tail = FALSE))))
  }
  full <- exactly(d, x, unname(c(fixef(fit), getME(fit, "theta"))))
  stopifnot(max(abs(full$par - c(fixef(fit), getME(fit, "theta")))) < 2e-3)
  chi <- sapply(2:ncol(x), function(k) 2 * (full$value - exactly(d, x[, -k, drop = FALSE], full$par[-k])$value))
  n <- length(full$par)
  c(d, list(boundary = FALSE, sd = full$par[n], beta = full$par[-n], errors = full$errors[-n],
    log_likelihood = full$value, chi = chi, p = pchisq(chi, 1, lower.tail = FALSE)))
})
write(toJSON(list(reliability = reliable, factorial = factorial, mixed = mixed), digits = I(17), null = "null", na = "null", auto_unbox = TRUE),
      file.path(here, "expected", "models.json"))
