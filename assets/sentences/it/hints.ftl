### What the assistant says with a hint. A message with several wordings gives them as attributes (.a, .b, ...); one is
### chosen each time, never the same twice running. The reason comes first, the place follows in a sentence of its own.
###
### A reason must be true of what the player has seen, whichever of the pair's two cards is pointed at. The classes
### count how often a card was turned up: "often" is twice or more, so say "più di una volta" and not "continuamente".
### On a second card the open card's own flip, just made, is counted too. Say nothing of what the player remembers.
### Write numbers as words: the only figures in a hint are the row and the column.
###
### Informal "tu", and nothing that tells whether the player is a woman or a man. The forms of a card are in cards.ftl;
### "gemella" is the other card with the same picture, and is feminine because "carta" is, whatever the picture.

## Reasons before a first card: one card of a pair, and the other

# Neither card of the pair was ever turned up.
reason-first-nothing-known =
    .a = Proviamo a guardare in un posto nuovo.
    .b = Qui c'è una coppia che non hai ancora incontrato.
    .c = C'è una coppia ancora tutta da scoprire.
# One card was turned up once, the other never.
reason-first-one-seen-once =
    .a = Hai visto una volta una carta con { $card-il }, l'altra non ancora.
    .b = Una delle due carte { $card-del } è già uscita una volta, l'altra ancora no.
    .c = { $card-genere ->
        [f] Di { $card-plurale } ne hai incontrata una sola, e una volta sola.
       *[m] Di { $card-plurale } ne hai incontrato uno solo, e una volta sola.
    }
# Both were turned up once.
reason-first-both-seen-once =
    .a = Hai visto tutte e due le carte con { $card-il }, una volta ciascuna.
    .b = Le due carte { $card-del } sono già uscite, una volta ciascuna.
    .c = { $card-genere ->
        [f] Le due { $card-plurale } le hai già incontrate, una volta ciascuna.
       *[m] I due { $card-plurale } li hai già incontrati, una volta ciascuno.
    }
# One was turned up twice or more, the other never.
reason-first-often-and-never =
    .a = Hai visto più di una volta una carta con { $card-il }, ma l'altra mai.
    .b = Una delle due carte { $card-del } è uscita almeno due volte, l'altra mai.
    .c = { $card-genere ->
        [f] Di { $card-plurale } ne hai incontrata una sola, ma più di una volta.
       *[m] Di { $card-plurale } ne hai incontrato uno solo, ma più di una volta.
    }
# One was turned up twice or more, the other once.
reason-first-often-and-once =
    .a = Hai visto più di una volta una carta con { $card-il }, e l'altra una volta sola.
    .b = Una delle due carte { $card-del } è uscita almeno due volte, l'altra soltanto una.
    .c = { $card-genere ->
        [f] Una delle due { $card-plurale } l'hai incontrata più di una volta, l'altra una volta sola.
       *[m] Uno dei due { $card-plurale } l'hai incontrato più di una volta, l'altro una volta sola.
    }
# Both were turned up twice or more.
reason-first-both-often =
    .a = Hai visto più di una volta tutte e due le carte con { $card-il }.
    .b = Le due carte { $card-del } sono uscite almeno due volte ciascuna.
    .c = { $card-genere ->
        [f] Le due { $card-plurale } le hai già incontrate più di una volta ciascuna.
       *[m] I due { $card-plurale } li hai già incontrati più di una volta ciascuno.
    }

## Reasons before a second card: the open card, and its partner

# The open card is up for the first time; its partner was never turned up.
reason-second-first-sight =
    .a = È la prima volta che vedi { $card-questo }, e la carta gemella non è ancora uscita.
    .b = Questa carta con { $card-il } è nuova, e la sua gemella non l'hai ancora vista.
    .c = { $card-genere ->
        [f] Questa è la prima { $card } che incontri: l'altra non l'hai ancora vista.
       *[m] Questo è il primo { $card } che incontri: l'altro non l'hai ancora visto.
    }
# The open card is up for the first time; its partner was turned up once.
reason-second-both-seen-once =
    .a = Questa carta con { $card-il } è nuova, ma la sua gemella l'hai già vista una volta.
    .b = L'altra carta { $card-del } è già uscita una volta.
    .c = È la prima volta che vedi { $card-questo }, ma una volta hai già incontrato { $card-genere ->
        [f] l'altra.
       *[m] l'altro.
    }
# The open card was turned up before; its partner never.
reason-second-often-and-never =
    .a = Questa carta con { $card-il } l'avevi già vista, la sua gemella mai.
    .b = Questa carta { $card-del } era già uscita, la sua gemella non ancora.
    .c = Avevi già incontrato { $card-questo }, ma non { $card-genere ->
        [f] l'altra.
       *[m] l'altro.
    }
# The open card was turned up before; its partner once.
reason-second-often-and-once =
    .a = Questa carta con { $card-il } l'avevi già vista, e la sua gemella l'hai vista una volta.
    .b = Questa carta { $card-del } era già uscita, e la sua gemella è uscita una volta.
    .c = Avevi già incontrato { $card-questo }, e una volta anche { $card-genere ->
        [f] l'altra.
       *[m] l'altro.
    }
# The open card is up for the first time; its partner was turned up twice or more.
reason-second-open-once-mate-often =
    .a = Questa carta con { $card-il } è nuova, ma la sua gemella l'hai già vista più di una volta.
    .b = L'altra carta { $card-del } è già uscita almeno due volte.
    .c = È la prima volta che vedi { $card-questo }, ma hai già incontrato più di una volta { $card-genere ->
        [f] l'altra.
       *[m] l'altro.
    }
# The open card was turned up before; its partner twice or more.
reason-second-both-often =
    .a = Hai visto più di una volta tutte e due le carte con { $card-il }.
    .b = Questa carta { $card-del } e la sua gemella sono uscite almeno due volte ciascuna.
    .c = { $card-genere ->
        [f] Le due { $card-plurale } le hai incontrate più di una volta ciascuna.
       *[m] I due { $card-plurale } li hai incontrati più di una volta ciascuno.
    }

## Reminders before a first card: said alone, without a place

# Neither card of the pair was ever turned up.
remind-first-nothing-known =
    .a = C'è una coppia che non hai ancora visto.
    .b = Due carte uguali non sono ancora uscite.
# One card was turned up once, the other never.
remind-first-one-seen-once =
    .a = Delle due carte con { $card-il } ne hai vista una, una volta; l'altra non ancora.
    .b = Una delle due carte con { $card-il } è uscita una volta, l'altra non ancora.
# Both were turned up once.
remind-first-both-seen-once =
    .a = Hai già visto tutte e due le carte con { $card-il }.
    .b = Le due carte con { $card-il } sono uscite tutte e due, una volta ciascuna.
# One was turned up twice or more, the other never.
remind-first-often-and-never =
    .a = Delle due carte con { $card-il } ne hai vista una più di una volta, l'altra mai.
    .b = Una delle due carte con { $card-il } è uscita almeno due volte, l'altra non ancora.
# One was turned up twice or more, the other once.
remind-first-often-and-once =
    .a = Delle due carte con { $card-il } ne hai vista una più di una volta, l'altra una volta sola.
    .b = Una delle due carte con { $card-il } è uscita almeno due volte, l'altra una volta sola.
# Both were turned up twice or more.
remind-first-both-often =
    .a = Hai già visto tutte e due le carte con { $card-il }, ciascuna più di una volta.
    .b = Le due carte con { $card-il } sono uscite tutte e due, almeno due volte ciascuna.

## Reminders before a second card

# The open card is up for the first time; its partner was never turned up.
remind-second-first-sight =
    .a = È la prima carta con { $card-il } che giri; l'altra non l'hai ancora vista.
    .b = L'altra carta con { $card-il } non è ancora uscita.
# The open card is up for the first time; its partner was turned up once.
remind-second-both-seen-once =
    .a = L'altra carta con { $card-il } l'hai già vista una volta.
    .b = L'altra carta con { $card-il } è già uscita una volta.
# The open card was turned up before; its partner never.
remind-second-often-and-never =
    .a = Questa carta con { $card-il } l'avevi già vista, l'altra non ancora.
    .b = Questa carta con { $card-il } era già uscita, l'altra non ancora.
# The open card was turned up before; its partner once.
remind-second-often-and-once =
    .a = Questa carta con { $card-il } l'avevi già vista, e l'altra l'hai vista una volta.
    .b = Questa carta con { $card-il } era già uscita, e l'altra è uscita una volta.
# The open card is up for the first time; its partner was turned up twice or more.
remind-second-open-once-mate-often =
    .a = L'altra carta con { $card-il } l'hai già vista più di una volta.
    .b = L'altra carta con { $card-il } è già uscita almeno due volte.
# The open card was turned up before; its partner twice or more.
remind-second-both-often =
    .a = Questa carta con { $card-il } l'avevi già vista, e l'altra l'hai vista più di una volta.
    .b = Questa carta con { $card-il } era già uscita, e l'altra è uscita almeno due volte.

## Places: a sentence may also stand alone, without a reason before it

point-first-column =
    .a = Prova una carta della colonna { $column }.
    .b = Dai un'occhiata alla colonna { $column }.
    .c = Io girerei una carta nella colonna { $column }.
point-first-row =
    .a = Prova una carta della riga { $row }.
    .b = Dai un'occhiata alla riga { $row }.
    .c = Io girerei una carta nella riga { $row }.
point-first-card =
    .a = Prova la carta in riga { $row }, colonna { $column }.
    .b = Dai un'occhiata alla carta in riga { $row }, colonna { $column }.
    .c = Io girerei la carta in riga { $row }, colonna { $column }.
point-second-column =
    .a = La carta gemella è nella colonna { $column }.
    .b = Cerca l'altra nella colonna { $column }.
    .c = Quella uguale la trovi nella colonna { $column }.
point-second-row =
    .a = La carta gemella è nella riga { $row }.
    .b = Cerca l'altra nella riga { $row }.
    .c = Quella uguale la trovi nella riga { $row }.
point-second-card =
    .a = La carta gemella è in riga { $row }, colonna { $column }.
    .b = Cerca l'altra in riga { $row }, colonna { $column }.
    .c = Quella uguale la trovi in riga { $row }, colonna { $column }.

## Commenti dopo una mossa, se la condizione li prevede: nessun posto, e niente su ciò che è stato visto

# Dopo una coppia trovata.
praise =
    .a = Ben fatto, è una coppia!
    .b = Una coppia. Ottimo!
    .c = Hai trovato una coppia. Complimenti!
# Dopo una mossa non riuscita.
encouragement =
    .a = Continua così!
    .b = Niente coppia, per ora. Ce la puoi fare!
    .c = Prenditi tutto il tempo che ti serve.
