# Two groups: tests, effect sizes, equivalence, Bayes factors. Writes expected/two_groups.json.
# Rscript tests/analysis/r/two_groups.R   (Debian: r-base-core r-recommended r-cran-coin r-cran-effectsize
#                                          r-cran-bayesfactor r-cran-jsonlite)
suppressPackageStartupMessages({library(coin); library(effectsize); library(BayesFactor); library(jsonlite); library(boot)})
here <- dirname(sub("--file=", "", grep("--file=", commandArgs(FALSE), value = TRUE)))
set.seed(20241101)

cases <- list(
  plain = list(x = round(rnorm(28, 55, 7.6), 3), y = round(rnorm(28, 58, 13.2), 3)),
  ties = list(x = c(12, 12, 13, 14, 14, 14, 15, 16, 16, 20), y = c(9, 12, 12, 12, 13, 14, 14, 11, 10, 14, 13, 12)),
  likert_sums = list(x = sample(8:18, 44, TRUE), y = sample(6:17, 43, TRUE)),
  outlier = list(x = c(1.1, 1.3, 0.9, 1.2, 1.05, 250), y = c(1.4, 1.2, 1.35, 1.6, 1.5, 1.55, 1.1)),
  unequal = list(x = round(rnorm(5, 10, 1), 4), y = round(rnorm(60, 12, 6), 4)),
  three_each = list(x = c(1, 2, 4), y = c(3, 5, 9)),
  one_constant = list(x = c(2, 2, 2, 2, 2), y = c(1, 2, 3, 4, 9, 2)),
  far_apart = list(x = round(rnorm(20, 100, 1), 4), y = round(rnorm(24, 88, 1.5), 4)),
  equal_means = list(x = c(1, 2, 3, 4, 5), y = c(5, 4, 3, 2, 1, 3)),
  large = list(x = sample(30:70, 120, TRUE), y = sample(32:75, 110, TRUE)))

# pt() is rough for noncentralities beyond 37, so the same integral stands in for it and is compared with it below.
noncentral <- function(t, df, ncp) {
  s <- sqrt(qchisq(c(1e-16, .5), df) / df); s <- c(s, sqrt(qchisq(1e-16, df, lower.tail = FALSE) / df))
  inside <- function(s) pnorm(t * s - ncp) * dchisq(df * s^2, df) * 2 * df * s
  sum(sapply(1:2, function(k) integrate(inside, s[k], s[k + 1], rel.tol = 1e-11, abs.tol = 0, subdivisions = 2000L, stop.on.error = FALSE)$value))
}
stopifnot(abs(noncentral(2.3, 54, 1.1) - pt(2.3, 54, 1.1)) < 1e-9, abs(noncentral(-1, 8, -2) - pt(-1, 8, -2)) < 1e-9)
ncp_limit <- function(t, df, chance) uniroot(function(ncp) noncentral(t, df, ncp) - chance, c(t - 15, t + 15), tol = 1e-12)$root

# The JZS integral; BayesFactor loses digits where the factor is astronomical, and agrees elsewhere.
jzs <- function(t, n, m, r) {
  df <- n + m - 2; size <- n * m / (n + m)
  log_inside <- function(z) { g <- exp(z); a <- 1 + size * g * r^2
    -.5 * log(a) - (df + 1) / 2 * log1p(t^2 / (a * df)) - .5 * log(2 * pi) - .5 * z - 1 / (2 * g) }
  z <- seq(-8, 60, by = .005); v <- log_inside(z); top <- max(v)
  bf <- exp(log(sum(exp(v - top)) * .005) + top + (df + 1) / 2 * log1p(t^2 / df))
  package <- exp(ttest.tstat(t, n, m, rscale = r)[["bf"]])
  stopifnot(abs(bf / package - 1) < if (abs(t) < 20) 1e-5 else 1e-2)
  bf
}

describe <- function(x, y) {
  n <- length(x); m <- length(y); both <- data.frame(v = c(x, y), g = factor(rep(c("x", "y"), c(n, m))))
  w <- t.test(x, y); s <- t.test(x, y, var.equal = TRUE)
  ranks <- wilcox_test(v ~ g, both, distribution = if (n * m <= 10000) "exact" else "asymptotic")
  u <- unname(suppressWarnings(wilcox.test(x, y))$statistic)
  normal <- suppressWarnings(wilcox.test(x, y, exact = FALSE))$p.value
  permuted <- if (choose(n + m, n) <= 50000) {
    sums <- combn(n + m, n, function(i) mean(both$v[i]) - mean(both$v[-i]))
    mean(abs(sums) >= abs(mean(x) - mean(y)) - 1e-9)
  } else NULL
  coin_permuted <- if (choose(n + m, n) <= 50000 && all(both$v == round(both$v)))
    as.numeric(pvalue(oneway_test(v ~ g, both, distribution = "exact"))) else NULL
  flat <- function(z) length(unique(z)) == 1
  sw <- function(z) if (flat(z)) NULL else { r <- shapiro.test(z); c(unname(r$statistic), r$p.value) }
  centred <- both; centred$v <- abs(both$v - ave(both$v, both$g, FUN = median)); lev <- anova(lm(v ~ g, centred))
  sp <- sqrt(((n - 1) * var(x) + (m - 1) * var(y)) / (n + m - 2)); scale <- sqrt(1 / n + 1 / m)
  d <- (mean(x) - mean(y)) / sp; df <- n + m - 2; t <- d / scale
  j <- exp(lgamma(df / 2) - lgamma((df - 1) / 2)) / sqrt(df / 2)
  limits <- c(ncp_limit(t, df, .975), ncp_limit(t, df, .025)) * scale
  g <- effectsize::hedges_g(x, y); e <- effectsize::cohens_d(x, y)
  bound <- 0.5 * sp
  low <- t.test(x, y, mu = -bound, alternative = "greater"); high <- t.test(x, y, mu = bound, alternative = "less")
  r <- 2 * u / (n * m) - 1; z <- qnorm(.975) * sqrt((n + m + 1) / (3 * n * m))
  scales <- c(.5, sqrt(.5), 1, 1.4)
  list(x = x, y = y,
    welch = c(unname(w$statistic), unname(w$parameter), w$p.value, w$conf.int),
    student = c(unname(s$statistic), unname(s$parameter), s$p.value, s$conf.int),
    u = u, rank_p = as.numeric(pvalue(ranks)), rank_p_normal = normal, exact = n * m <= 10000,
    rank_biserial = c(r, if (abs(r) == 1) c(r, r) else tanh(atanh(r) + c(-z, z))),
    rank_biserial_effectsize = unlist(effectsize::rank_biserial(x, y)[c("r_rank_biserial", "CI_low", "CI_high")], use.names = FALSE),
    permutation_p = permuted, permutation_p_coin = coin_permuted,
    shapiro_x = sw(x), shapiro_y = sw(y),
    brown_forsythe = c(lev[1, "F value"], lev[1, "Pr(>F)"]),
    cohen_d = c(d, limits), hedges_g = c(d, limits) * j,
    cohen_d_effectsize = c(e$Cohens_d, e$CI_low, e$CI_high), hedges_g_effectsize = g$Hedges_g,
    tost = c(bound, max(low$p.value, high$p.value), t.test(x, y, conf.level = .9)$conf.int),
    bayes_factors = sapply(scales, function(r) jzs(unname(s$statistic), n, m, r)),
    power_d = power.t.test(n = max(3, n), delta = .5, sd = 1, strict = TRUE)$power)
}
two <- lapply(cases, function(case) do.call(describe, case))

# A bootstrap whose values are given, so that the interval can be compared without sharing a generator of chance.
x <- cases$plain$x; y <- cases$plain$y
values <- replicate(1999, mean(sample(x, replace = TRUE)) - mean(sample(y, replace = TRUE)))
influence <- c((x - mean(x)) * (56 / 28), -(y - mean(y)) * (56 / 28))
b <- list(t0 = mean(x) - mean(y), t = matrix(values), R = length(values), data = c(x, y), sim = "ordinary", call = quote(boot()))
class(b) <- "boot"
interval <- boot.ci(b, conf = .95, type = "bca", t0 = b$t0, t = values, L = influence)$bca[4:5]

ps <- c(.01, .04, .03, NA, .5, .049, .001, .04)
counts <- list(rbind(c(28, 2), c(25, 9)), rbind(c(5, 0), c(1, 7)), rbind(c(40, 4), c(44, 4)))
answer <- list(
  cases = two,
  bca = list(values = values, value = b$t0, influence = influence, interval = interval),
  corrections = list(p = ps, holm = p.adjust(ps, "holm"), bh = p.adjust(ps, "BH")),
  fisher = list(tables = counts, p = sapply(counts, function(m) fisher.test(m)$p.value)),
  wilson = list(hits = c(0, 3, 17, 28), n = c(12, 20, 17, 44),
    low = mapply(function(h, n) prop.test(h, n, correct = FALSE)$conf.int[1], c(0, 3, 17, 28), c(12, 20, 17, 44)),
    high = mapply(function(h, n) prop.test(h, n, correct = FALSE)$conf.int[2], c(0, 3, 17, 28), c(12, 20, 17, 44))),
  noncentral = {
    grid <- expand.grid(t = c(-3, 0, .7, 2.5, 8, 25), df = c(4, 27.3, 54, 1000), ncp = c(-6, 0, 1.5, 9, 30))
    list(t = grid$t, df = grid$df, ncp = grid$ncp, p = suppressWarnings(pt(grid$t, grid$df, grid$ncp)))
  },
  power = list(d = c(.35, .35, .5, .8), n = c(28, 129, 64, 26),
    power = mapply(function(d, n) power.t.test(n = n, delta = d, sd = 1, strict = TRUE)$power, c(.35, .35, .5, .8), c(28, 129, 64, 26)),
    sensitivity = sapply(c(28, 129, 64, 26), function(n) uniroot(function(d) power.t.test(n = n, delta = d, sd = 1, strict = TRUE)$power - .8, c(.05, 5), tol = 1e-12)$root)))
write(toJSON(answer, digits = I(17), null = "null", na = "null", auto_unbox = TRUE), file.path(here, "expected", "two_groups.json"))
