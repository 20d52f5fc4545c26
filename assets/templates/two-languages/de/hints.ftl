### What the assistant says with a hint, in German. The comments say when a message is used; the English file
### ("hints.ftl" of the language "en") says what a sentence has to be true of. "Gegenstück" is the other card of a pair.

## Reasons before a first card: one card of a pair, and the other

# Neither card of the pair was ever turned up.
reason-first-nothing-known =
    .a = Schauen wir, wo noch alles neu ist.
    .b = Hier ist ein Paar, dem du noch nicht begegnet bist.
    .c = Ein Paar wartet noch darauf, zum ersten Mal gesehen zu werden.
# One card was turned up once, the other never.
reason-first-one-seen-once =
    .a = Eine { $card }-Karte hast du einmal gesehen, die andere noch nicht.
    .b = Eine { $card }-Karte lag schon einmal offen; die andere ist noch ungesehen.
    .c = Du bist einer { $card }-Karte einmal begegnet, der anderen noch nicht.
# Both were turned up once.
reason-first-both-seen-once =
    .a = Du hast beide { $card }-Karten gesehen, jede einmal.
    .b = Beide { $card }-Karten lagen schon je einmal offen.
    .c = Den zwei { $card }-Karten bist du je einmal begegnet.
# One was turned up twice or more, the other never.
reason-first-often-and-never =
    .a = Eine { $card }-Karte hast du mehr als einmal gesehen, die andere noch nie.
    .b = Eine { $card }-Karte lag mindestens zweimal offen, die andere noch gar nicht.
    .c = Du hast dieselbe { $card }-Karte mehr als einmal aufgedeckt, die andere noch nie.
# One was turned up twice or more, the other once.
reason-first-often-and-once =
    .a = Eine { $card }-Karte hast du mehr als einmal gesehen, die andere genau einmal.
    .b = Eine { $card }-Karte lag mindestens zweimal offen, die andere nur einmal.
    .c = Du bist einer { $card }-Karte mehr als einmal begegnet, der anderen ein einziges Mal.
# Both were turned up twice or more.
reason-first-both-often =
    .a = Du hast beide { $card }-Karten mehr als einmal gesehen.
    .b = Beide { $card }-Karten lagen schon mindestens zweimal offen.
    .c = Jeder der zwei { $card }-Karten bist du mehr als einmal begegnet.

## Reasons before a second card: the open card, and its partner

# The open card is up for the first time; its partner was never turned up.
reason-second-first-sight =
    .a = Diese { $card }-Karte ist neu, und auch ihr Gegenstück hast du noch nicht gesehen.
    .b = Diese { $card }-Karte liegt zum ersten Mal offen, und ihr Gegenstück ist noch ungesehen.
    .c = Dieser { $card }-Karte bist du noch nie begegnet, und ihrem Gegenstück auch nicht.
# The open card is up for the first time; its partner was turned up once.
reason-second-both-seen-once =
    .a = Diese { $card }-Karte ist neu, aber ihr Gegenstück hast du einmal gesehen.
    .b = Die andere { $card }-Karte hast du schon einmal gesehen.
    .c = Dem Gegenstück dieser { $card }-Karte bist du schon einmal begegnet.
# The open card was turned up before; its partner never.
reason-second-often-and-never =
    .a = Diese { $card }-Karte hast du schon gesehen, ihr Gegenstück noch nie.
    .b = Diese { $card }-Karte lag schon offen; ihr Gegenstück noch nicht.
    .c = Dieser { $card }-Karte bist du schon begegnet. Ihr Gegenstück ist noch ungesehen.
# The open card was turned up before; its partner once.
reason-second-often-and-once =
    .a = Diese { $card }-Karte hast du schon gesehen, und ihr Gegenstück einmal.
    .b = Diese { $card }-Karte lag schon offen, und ihr Gegenstück einmal.
    .c = Dieser { $card }-Karte bist du schon begegnet, und ihrem Gegenstück einmal.
# The open card is up for the first time; its partner was turned up twice or more.
reason-second-open-once-mate-often =
    .a = Diese { $card }-Karte ist neu, aber ihr Gegenstück hast du mehr als einmal gesehen.
    .b = Der anderen { $card }-Karte bist du mehr als einmal begegnet.
    .c = Das Gegenstück dieser { $card }-Karte lag mindestens zweimal offen.
# The open card was turned up before; its partner twice or more.
reason-second-both-often =
    .a = Du hast beide { $card }-Karten mehr als einmal gesehen.
    .b = Dieser { $card }-Karte und ihrem Gegenstück bist du je mehr als einmal begegnet.
    .c = Diese { $card }-Karte und ihr Gegenstück lagen beide mindestens zweimal offen.

## Reminders before a first card: said alone, without a place

# Neither card of the pair was ever turned up.
remind-first-nothing-known =
    .a = Es gibt ein Paar, das du noch nicht aufgedeckt hast.
    .b = Zwei Karten, die zusammengehören, sind noch ungesehen.
# One card was turned up once, the other never.
remind-first-one-seen-once =
    .a = Es gibt zwei { $card }-Karten: Eine hast du einmal gesehen, die andere nicht.
    .b = Eine der zwei { $card }-Karten lag einmal offen; die andere ist noch ungesehen.
# Both were turned up once.
remind-first-both-seen-once =
    .a = Du hast beide { $card }-Karten gesehen.
    .b = Beide { $card }-Karten lagen schon offen, jede einmal.
# One was turned up twice or more, the other never.
remind-first-often-and-never =
    .a = Es gibt zwei { $card }-Karten: Eine hast du mehr als einmal gesehen, die andere noch nie.
    .b = Eine der zwei { $card }-Karten lag mindestens zweimal offen, die andere noch gar nicht.
# One was turned up twice or more, the other once.
remind-first-often-and-once =
    .a = Es gibt zwei { $card }-Karten: Eine hast du mehr als einmal gesehen, die andere genau einmal.
    .b = Eine der zwei { $card }-Karten lag mindestens zweimal offen, die andere nur einmal.
# Both were turned up twice or more.
remind-first-both-often =
    .a = Du hast beide { $card }-Karten mehr als einmal gesehen.
    .b = Beide { $card }-Karten lagen schon offen, jede mindestens zweimal.

## Reminders before a second card

# The open card is up for the first time; its partner was never turned up.
remind-second-first-sight =
    .a = Das ist die erste { $card }-Karte, die du aufdeckst; die andere hast du noch nicht gesehen.
    .b = Die andere { $card }-Karte lag noch nicht offen.
# The open card is up for the first time; its partner was turned up once.
remind-second-both-seen-once =
    .a = Die andere { $card }-Karte hast du einmal gesehen.
    .b = Die andere { $card }-Karte lag schon einmal offen.
# The open card was turned up before; its partner never.
remind-second-often-and-never =
    .a = Diese { $card }-Karte hast du schon gesehen, die andere noch nicht.
    .b = Diese { $card }-Karte lag schon offen; die andere noch nicht.
# The open card was turned up before; its partner once.
remind-second-often-and-once =
    .a = Diese { $card }-Karte hast du schon gesehen, und die andere einmal.
    .b = Diese { $card }-Karte lag schon offen, und die andere einmal.
# The open card is up for the first time; its partner was turned up twice or more.
remind-second-open-once-mate-often =
    .a = Die andere { $card }-Karte hast du mehr als einmal gesehen.
    .b = Die andere { $card }-Karte lag mindestens zweimal offen.
# The open card was turned up before; its partner twice or more.
remind-second-both-often =
    .a = Diese { $card }-Karte hast du schon gesehen, und die andere mehr als einmal.
    .b = Diese { $card }-Karte lag schon offen, und die andere mindestens zweimal.

## Places: a sentence may also stand alone, without a reason before it

point-first-column =
    .a = Versuch eine Karte in Spalte { $column }.
    .b = Schau einmal in Spalte { $column }.
    .c = Ich würde eine Karte in Spalte { $column } aufdecken.
point-first-row =
    .a = Versuch eine Karte in Reihe { $row }.
    .b = Schau einmal in Reihe { $row }.
    .c = Ich würde eine Karte in Reihe { $row } aufdecken.
point-first-card =
    .a = Versuch die Karte in Reihe { $row }, Spalte { $column }.
    .b = Schau einmal in Reihe { $row }, Spalte { $column }.
    .c = Ich würde die Karte in Reihe { $row }, Spalte { $column } aufdecken.
point-second-column =
    .a = Das Gegenstück ist in Spalte { $column }.
    .b = Such das Gegenstück in Spalte { $column }.
    .c = Die passende Karte findest du in Spalte { $column }.
point-second-row =
    .a = Das Gegenstück ist in Reihe { $row }.
    .b = Such das Gegenstück in Reihe { $row }.
    .c = Die passende Karte findest du in Reihe { $row }.
point-second-card =
    .a = Das Gegenstück ist in Reihe { $row }, Spalte { $column }.
    .b = Such das Gegenstück in Reihe { $row }, Spalte { $column }.
    .c = Die passende Karte findest du in Reihe { $row }, Spalte { $column }.

## Bemerkungen nach einem Zug, wo eine Bedingung sie hat: kein Ort, und nichts über das, was gesehen wurde

# Nach einem gefundenen Paar.
praise =
    .a = Gut gemacht, das ist ein Paar!
    .b = Ein Paar. Sehr gut!
    .c = Du hast ein Paar gefunden. Prima!
# Nach einem Zug ohne Paar.
encouragement =
    .a = Nur weiter!
    .b = Kein Paar, dieses Mal. Du schaffst das!
    .c = Nimm dir alle Zeit, die du brauchst.
