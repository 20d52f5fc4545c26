### What the assistant says with a hint. A message with several wordings gives them as attributes (.a, .b, ...); one is
### chosen each time, never the same twice running. The reason comes first, the place follows in a sentence of its own.
###
### A reason must be true of what the player has seen, whichever of the pair's two cards is pointed at. The classes
### count how often a card was turned up: "often" is twice or more, so say "more than once" and not "again and again".
### On a second card the open card's own flip, just made, is counted too. Say nothing of what the player remembers.
### Write numbers as words: the only figures in a hint are the row and the column.
###
### $card is the name of the picture as it stands in cards.ftl.

## Reasons before a first card: one card of a pair, and the other

# Neither card of the pair was ever turned up.
reason-first-nothing-known =
    .a = Let us look somewhere new.
    .b = Here is a pair that you have not met yet.
    .c = There is a pair still waiting to be seen for the first time.
# One card was turned up once, the other never.
reason-first-one-seen-once =
    .a = You have seen one { $card } card once, and the other one not yet.
    .b = One { $card } card has been up once; the other is still unseen.
    .c = You have seen one { $card } card once, but never its partner.
# Both were turned up once.
reason-first-both-seen-once =
    .a = You have seen both { $card } cards, each of them once.
    .b = Both { $card } cards have been up once already.
    .c = You have met the two { $card } cards once each.
# One was turned up twice or more, the other never.
reason-first-often-and-never =
    .a = You have seen one { $card } card more than once, and the other one never.
    .b = One { $card } card has been up at least twice, the other not at all.
    .c = You have turned up the same { $card } card more than once, but never the other one.
# One was turned up twice or more, the other once.
reason-first-often-and-once =
    .a = You have seen one { $card } card more than once, and the other one just once.
    .b = One { $card } card has been up at least twice, the other only once.
    .c = You have met one { $card } card more than once, and the other a single time.
# Both were turned up twice or more.
reason-first-both-often =
    .a = You have seen both { $card } cards more than once.
    .b = Both { $card } cards have been up at least twice by now.
    .c = You have met each of the two { $card } cards more than once.

## Reasons before a second card: the open card, and its partner

# The open card is up for the first time; its partner was never turned up.
reason-second-first-sight =
    .a = This { $card } card is new, and its partner has not been seen yet either.
    .b = This { $card } card is up for the first time, and its partner is still unseen.
    .c = You had not met this { $card } card before, nor its partner.
# The open card is up for the first time; its partner was turned up once.
reason-second-both-seen-once =
    .a = This { $card } card is new, but you have seen its partner once.
    .b = You have seen the other { $card } card once before.
    .c = You have already met the partner of this { $card } card once.
# The open card was turned up before; its partner never.
reason-second-often-and-never =
    .a = You have seen this { $card } card before, but never its partner.
    .b = This { $card } card was up before; its partner has not been up yet.
    .c = You have met this { $card } card already. Its partner is still unseen.
# The open card was turned up before; its partner once.
reason-second-often-and-once =
    .a = You have seen this { $card } card before, and its partner once.
    .b = This { $card } card was up before, and its partner has been up once.
    .c = You have met this { $card } card already, and its partner once.
# The open card is up for the first time; its partner was turned up twice or more.
reason-second-open-once-mate-often =
    .a = This { $card } card is new, but you have seen its partner more than once.
    .b = You have met the other { $card } card more than once.
    .c = The partner of this { $card } card has been up at least twice.
# The open card was turned up before; its partner twice or more.
reason-second-both-often =
    .a = You have seen both { $card } cards more than once.
    .b = You have met this { $card } card and its partner more than once each.
    .c = This { $card } card and its partner have both been up at least twice.

## Reminders before a first card: said alone, without a place

# Neither card of the pair was ever turned up.
remind-first-nothing-known =
    .a = There is a pair that you have not turned up yet.
    .b = Two cards that belong together are still unseen.
# One card was turned up once, the other never.
remind-first-one-seen-once =
    .a = There are two { $card } cards: you have seen one of them once, and not the other.
    .b = One of the two { $card } cards has been up once; the other is still unseen.
# Both were turned up once.
remind-first-both-seen-once =
    .a = You have seen both { $card } cards.
    .b = Both { $card } cards have been up, each of them once.
# One was turned up twice or more, the other never.
remind-first-often-and-never =
    .a = There are two { $card } cards: you have seen one of them more than once, the other never.
    .b = One of the two { $card } cards has been up at least twice, the other not at all.
# One was turned up twice or more, the other once.
remind-first-often-and-once =
    .a = There are two { $card } cards: you have seen one of them more than once, the other just once.
    .b = One of the two { $card } cards has been up at least twice, the other only once.
# Both were turned up twice or more.
remind-first-both-often =
    .a = You have seen both { $card } cards more than once.
    .b = Both { $card } cards have been up, each of them at least twice.

## Reminders before a second card

# The open card is up for the first time; its partner was never turned up.
remind-second-first-sight =
    .a = This is the first { $card } card that you turn up; you have not seen the other one.
    .b = The other { $card } card has not been up yet.
# The open card is up for the first time; its partner was turned up once.
remind-second-both-seen-once =
    .a = You have seen the other { $card } card once.
    .b = The other { $card } card has been up once before.
# The open card was turned up before; its partner never.
remind-second-often-and-never =
    .a = You have seen this { $card } card before, but not the other one.
    .b = This { $card } card was up before; the other one has not been up yet.
# The open card was turned up before; its partner once.
remind-second-often-and-once =
    .a = You have seen this { $card } card before, and the other one once.
    .b = This { $card } card was up before, and the other one has been up once.
# The open card is up for the first time; its partner was turned up twice or more.
remind-second-open-once-mate-often =
    .a = You have seen the other { $card } card more than once.
    .b = The other { $card } card has been up at least twice.
# The open card was turned up before; its partner twice or more.
remind-second-both-often =
    .a = You have seen this { $card } card before, and the other one more than once.
    .b = This { $card } card was up before, and the other one has been up at least twice.

## Places: a sentence may also stand alone, without a reason before it

point-first-column =
    .a = Try a card in column { $column }.
    .b = Have a look in column { $column }.
    .c = I would turn a card in column { $column }.
point-first-row =
    .a = Try a card in row { $row }.
    .b = Have a look in row { $row }.
    .c = I would turn a card in row { $row }.
point-first-card =
    .a = Try the card in row { $row }, column { $column }.
    .b = Have a look at row { $row }, column { $column }.
    .c = I would turn the card in row { $row }, column { $column }.
point-second-column =
    .a = The partner is in column { $column }.
    .b = Look for its partner in column { $column }.
    .c = You will find the match in column { $column }.
point-second-row =
    .a = The partner is in row { $row }.
    .b = Look for its partner in row { $row }.
    .c = You will find the match in row { $row }.
point-second-card =
    .a = The partner is in row { $row }, column { $column }.
    .b = Look for its partner in row { $row }, column { $column }.
    .c = You will find the match in row { $row }, column { $column }.

## Comments after a move, where a condition has them: no place, and nothing about what was seen

# After a pair was found.
praise =
    .a = Well done, that is a pair!
    .b = A pair. Very good!
    .c = You found a pair. Nicely done!
# After a move that missed.
encouragement =
    .a = Keep going!
    .b = No pair this time. You can do it!
    .c = Take all the time you need.
