# A whole study: reads the tables of an exported data set and works out what a report says of it.
# Rscript tests/analysis/r/report.R   (reads four_cells.zip beside it, writes expected/report.json)
suppressPackageStartupMessages({library(coin); library(BayesFactor); library(psych); library(lme4); library(jsonlite)})
here <- dirname(sub("--file=", "", grep("--file=", commandArgs(FALSE), value = TRUE)))
folder <- tempfile(); unzip(file.path(here, "four_cells.zip"), exdir = folder)
table_of <- function(name) read.csv(file.path(folder, "data", sprintf("task-concentration_description-%s_data.csv", name)), colClasses = "character")
num <- function(x) as.numeric(ifelse(x %in% c("true", "false"), x == "true", x))
everyone <- table_of("participants"); hints <- table_of("hints"); flips <- table_of("flips"); scores <- table_of("scores"); answers <- table_of("answers")

# Who is analysed.
drawn <- everyone[!everyone$allocation_source %in% c("override", "beyond"), ]
people <- drawn[drawn$game_completed == "true", ]
cells <- c("tom", "notom", "mentalised_unexplained", "random_explained"); pair <- c("tom", "notom")
game <- c("flips", "completion_ms", "completion_with_speech_ms", "per_match_ms", "hints", "assistance_per_flip", "followed_rate", "first_followed_rate", "first_led_to_match_rate")
values <- setNames(lapply(game, function(m) num(people[[m]])), game)
for (scale in unique(scores$scale)) { s <- scores[scores$scale == scale, ]; values[[paste0(scale, "_sum")]] <- num(s$sum[match(people$participant_id, s$participant_id)]) }
of <- function(m, cell) { v <- values[[m]][people$condition == cell]; v[!is.na(v)] }
completion <- lapply(cells, function(cell) { d <- drawn[drawn$condition == cell, ]; k <- sum(d$game_completed == "true")
  list(condition = cell, allocated = nrow(d), completed = k, interval = as.numeric(prop.test(k, nrow(d), correct = FALSE)$conf.int), ended = as.list(table(d$last_stage[d$game_completed != "true"]))) })
fisher_p <- fisher.test(sapply(pair, function(cell) table(factor(drawn$game_completed[drawn$condition == cell], c("true", "false")))))$p.value
descriptives <- do.call(c, lapply(names(values), function(m) lapply(cells, function(cell) { v <- of(m, cell)
  list(measure = m, condition = cell, n = length(v), mean = mean(v), sd = sd(v), quartiles = unname(quantile(v))) })))

# The plan's two conditions.
ncp_limit <- function(t, df, chance) uniroot(function(ncp) pt(t, df, ncp) - chance, c(t - 15, t + 15), tol = 1e-13)$root
g_of <- function(x, y) { n <- length(x); m <- length(y); df <- n + m - 2; scale <- sqrt(1 / n + 1 / m)
  t <- unname(t.test(x, y, var.equal = TRUE)$statistic); j <- exp(lgamma(df / 2) - lgamma((df - 1) / 2)) / sqrt(df / 2)
  c(t, ncp_limit(t, df, .975), ncp_limit(t, df, .025)) * scale * j }
compared <- lapply(names(values), function(m) { x <- of(m, pair[1]); y <- of(m, pair[2])
  w <- t.test(x, y); s <- t.test(x, y, var.equal = TRUE); both <- data.frame(v = c(x, y), g = factor(rep(pair, c(length(x), length(y))), pair))
  list(measure = m, n = c(length(x), length(y)), welch = c(unname(w$statistic), unname(w$parameter), w$p.value, w$conf.int),
    student = c(unname(s$statistic), s$p.value), u = unname(suppressWarnings(wilcox.test(x, y))$statistic),
    rank_p = as.numeric(pvalue(wilcox_test(v ~ g, both, distribution = "exact"))), g = g_of(x, y),
    bayes = sapply(c(.5, sqrt(.5), 1, 1.4), function(r) exp(ttest.tstat(unname(s$statistic), length(x), length(y), rscale = r)[["bf"]])),
    shapiro = c(shapiro.test(x)$p.value, shapiro.test(y)$p.value)) })
hypotheses <- data.frame(id = c("H1-flips", "H1-time", "H2-assistance", "H3-social", "H3-competence"),
  measure = c("flips", "completion_ms", "assistance_per_flip", "SOC_sum", "AC_sum"), side = c("less", "less", "less", "greater", "greater"),
  family = c("performance", "performance", "assistance", "perception", "perception"))
within_2sd <- function(x, y) { b <- c(x, y); keep <- function(v) v[abs(v - mean(b)) <= 2 * sd(b)]; list(keep(x), keep(y)) }
hypotheses$p <- sapply(1:5, function(k) t.test(of(hypotheses$measure[k], pair[1]), of(hypotheses$measure[k], pair[2]), alternative = hypotheses$side[k])$p.value)
hypotheses$corrected <- ave(hypotheses$p, hypotheses$family, FUN = function(p) p.adjust(p, "holm"))
paper <- lapply(1:5, function(k) { v <- within_2sd(of(hypotheses$measure[k], pair[1]), of(hypotheses$measure[k], pair[2]))
  list(n = lengths(v), p = t.test(v[[1]], v[[2]], var.equal = TRUE, alternative = hypotheses$side[k])$p.value) })

# All four cells.
mentalised <- c(tom = 1, notom = 0, mentalised_unexplained = 1, random_explained = 0); explained <- c(tom = 1, notom = 0, mentalised_unexplained = 0, random_explained = 1)
design <- lapply(names(values), function(m) { d <- data.frame(v = values[[m]], a = factor(mentalised[people$condition]), b = factor(explained[people$condition]))
  fit <- lm(v ~ a * b, d, contrasts = list(a = "contr.sum", b = "contr.sum")); tests <- drop1(fit, . ~ ., test = "F")[-1, ]
  list(measure = m, f = tests$`F value`, p = tests$`Pr(>F)`, df = fit$df.residual, size = tests$`Sum of Sq` / (tests$`Sum of Sq` + sum(resid(fit)^2))) })

# Scales.
answers <- answers[answers$scale != "" & answers$participant_id %in% people$participant_id, ]
reliable <- lapply(unique(answers$scale), function(scale) { a <- answers[answers$scale == scale, ]
  wide <- tapply(num(a$scored), list(a$participant_id, a$item), function(v) v[1]); wide <- wide[complete.cases(wide), ]
  alpha <- suppressMessages(suppressWarnings(psych::alpha(wide)))$total$raw_alpha; n <- nrow(wide); k <- ncol(wide)
  list(scale = scale, n = n, alpha = c(alpha, 1 - (1 - alpha) * qf(c(.975, .025), n - 1, (n - 1) * (k - 1)))) })

# Single hints and moves. lme4 stops a little before the maximum, so it is started again from where it stopped.
exactly <- function(formula, d) { control <- glmerControl(optimizer = "bobyqa", optCtrl = list(rhobeg = 1e-3, rhoend = 1e-9, maxfun = 1e5))
  fit <- suppressMessages(suppressWarnings(glmer(formula, d, binomial, nAGQ = 25)))
  for (k in 1:3) fit <- suppressMessages(suppressWarnings(update(fit, start = list(theta = getME(fit, "theta"), fixef = fixef(fit)), control = control)))
  fit }
model <- function(formula, d) { d <- d[complete.cases(d), ]; fit <- exactly(update(formula, . ~ . + (1 | person)), d); terms <- attr(terms(formula), "term.labels")
  boundary <- getME(fit, "theta") < 1e-3
  if (boundary) fit <- glm(formula, binomial, d, control = glm.control(1e-14, 100))
  less <- function(term) { f <- update(formula, paste(". ~ . -", term)); if (boundary) glm(f, binomial, d, control = glm.control(1e-14, 100)) else exactly(update(f, . ~ . + (1 | person)), d) }
  chi <- sapply(terms, function(term) 2 * (as.numeric(logLik(fit)) - as.numeric(logLik(less(term)))))
  list(boundary = boundary, sd = if (boundary) 0 else unname(getME(fit, "theta")), beta = unname(if (boundary) coef(fit) else fixef(fit)), chi = unname(chi), n = nrow(d)) }
hints <- hints[hints$participant_id %in% people$participant_id & hints$followed != "", ]
hints$condition <- people$condition[match(hints$participant_id, people$participant_id)]; hints$person <- factor(hints$participant_id)
hints$pair <- ifelse(hints$condition == pair[1], 1, ifelse(hints$condition == pair[2], 0, NA))
hints$a <- mentalised[hints$condition] - .5; hints$b <- explained[hints$condition] - .5; hints$ab <- hints$a * hints$b
hints$hit <- num(hints$followed); first <- hints[hints$move_card == "first", ]; first$hit <- num(first$followed) * (first$move_matched == "true")
moves <- flips[flips$participant_id %in% people$participant_id & flips$stage == "game" & flips$move_card == "second", ]
moves$hit <- num(moves$matched); moves$person <- factor(moves$participant_id); moves$hinted <- num(moves$hinted)
before <- ave(moves$hit, moves$person, FUN = function(v) cumsum(v) - v)
moves$middle <- as.numeric(before %/% 4 == 1); moves$end <- as.numeric(before %/% 4 >= 2)
moves$condition <- people$condition[match(moves$participant_id, people$participant_id)]
moves$pair <- ifelse(moves$condition == pair[1], 1, ifelse(moves$condition == pair[2], 0, NA))
models <- list(followed = model(hit ~ pair, hints[c("hit", "pair", "person")]), `followed, 2 x 2` = model(hit ~ a + b + ab, hints[c("hit", "a", "b", "ab", "person")]),
  `led to match` = model(hit ~ pair, first[c("hit", "pair", "person")]), `led to match, 2 x 2` = model(hit ~ a + b + ab, first[c("hit", "a", "b", "ab", "person")]),
  `second card matches` = model(hit ~ pair + hinted + middle + end, moves[c("hit", "pair", "hinted", "middle", "end", "person")]))
write(toJSON(list(analysed = as.list(table(people$condition)), completion = completion, fisher_p = fisher_p, descriptives = descriptives, compared = compared,
  hypotheses = hypotheses, paper = paper, design = design, reliable = reliable, models = models), digits = I(17), null = "null", na = "null", auto_unbox = TRUE),
  file.path(here, "expected", "report.json"))
