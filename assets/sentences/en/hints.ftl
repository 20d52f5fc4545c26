### What the assistant says with a hint. A message with several wordings gives them as attributes (.a, .b, ...); one is
### chosen each time, never the same twice running. A reason must be true of what the player has seen, whichever of the
### pair's two cards is pointed at; the place follows in a sentence of its own.
### $card is the name of the animal as it stands under "Names of the cards".

## Names of the cards

card-bear = bear
card-butterfly = butterfly
card-cat = cat
card-duck = duck
card-elephant = elephant
card-fish = fish
card-frog = frog
card-hedgehog = hedgehog
card-ladybird = ladybird
card-owl = owl
card-rabbit = rabbit
card-turtle = turtle

## Reasons before a first card: one card of a pair, and the other

reason-first-nothing-known =
    .a = Let us look somewhere new.
    .b = Here is a pair that you have not met yet.
    .c = There is a pair still waiting to be seen for the first time.
reason-first-one-seen-once =
    .a = You have seen one { $card } card once, and the other one not yet.
    .b = One { $card } card has been up once; the second is still unseen.
    .c = You met one { $card } card, but not the other.
reason-first-both-seen-once =
    .a = You have seen both { $card } cards, each of them once.
    .b = Both { $card } cards have been up once already.
    .c = You met the two { $card } cards once each.
reason-first-often-and-never =
    .a = You keep meeting one { $card } card, and the other one you have never seen.
    .b = One { $card } card has been up more than once, the other not at all.
    .c = You know one { $card } card quite well by now, but not the other one.
reason-first-often-and-once =
    .a = You have seen one { $card } card more than once, and the other one once.
    .b = One { $card } card comes up again and again; the other you saw just once.
    .c = One { $card } card should be familiar to you, the other you only met once.
reason-first-both-often =
    .a = You have seen both { $card } cards more than once.
    .b = Both { $card } cards have been up more than once by now.
    .c = You keep meeting the two { $card } cards.

## Reasons before a second card: the open card, and its partner

reason-second-first-sight =
    .a = This { $card } is new, and its partner has not been seen yet either.
    .b = This { $card } card is up for the first time, and its partner is still unseen.
    .c = You have met neither this { $card } card nor its partner before.
reason-second-both-seen-once =
    .a = This { $card } card is new, but you have seen its partner once.
    .b = You saw another { $card } card once before.
    .c = You already met the other { $card } card one time.
reason-second-often-and-never =
    .a = You have seen this { $card } card before, but never its partner.
    .b = This { $card } card is an old friend; its partner is still hiding.
    .c = You know this { $card } card already. Its partner has not been up yet.
reason-second-often-and-once =
    .a = You have seen this { $card } card before, and its partner once.
    .b = This { $card } card was up before, and its partner showed up once.
    .c = You know this { $card } card, and you met its partner one time.
reason-second-open-once-mate-often =
    .a = This { $card } card is new, but you have seen its partner more than once.
    .b = You have met the other { $card } card more than once.
    .c = The partner of this { $card } card is an old friend of yours.
reason-second-both-often =
    .a = You have seen both { $card } cards more than once.
    .b = You have met this { $card } card and its partner more than once each.
    .c = You keep meeting these two { $card } cards.

## Places

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
    .b = Look for it in column { $column }.
    .c = You will find the match in column { $column }.
point-second-row =
    .a = The partner is in row { $row }.
    .b = Look for it in row { $row }.
    .c = You will find the match in row { $row }.
point-second-card =
    .a = The partner is in row { $row }, column { $column }.
    .b = Look for it in row { $row }, column { $column }.
    .c = You will find the match in row { $row }, column { $column }.
