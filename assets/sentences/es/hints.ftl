### What the assistant says with a hint. A message with several wordings gives them as attributes (.a, .b, ...); one is
### chosen each time, never the same twice running. The reason comes first, the place follows in a sentence of its own.
###
### A reason must be true of what the player has seen, whichever of the pair's two cards is pointed at. The classes
### count how often a card was turned up: "often" is twice or more, so say "más de una vez" and not "una y otra vez".
### On a second card the open card's own flip, just made, is counted too. Say nothing of what the player remembers.
### Write numbers as words: the only figures in a hint are the row and the column.
###
### Informal "tú", and nothing that tells whether the player is a woman or a man. The forms of a card are in cards.ftl;
### "su pareja" is the other card with the same picture.

## Reasons before a first card: one card of a pair, and the other

# Neither card of the pair was ever turned up.
reason-first-nothing-known =
    .a = Vamos a mirar en un sitio nuevo.
    .b = Aquí hay una pareja que todavía no has visto.
    .c = Queda una pareja que aún está por descubrir.
# One card was turned up once, the other never.
reason-first-one-seen-once =
    .a = Has visto una vez una carta con { $card-el }; la otra, todavía no.
    .b = Una de las dos cartas { $card-del } ya ha salido una vez; la otra, aún no.
    .c = { $card-genero ->
        [f] De las dos { $card-plural } solo has visto una, y una sola vez.
       *[m] De los dos { $card-plural } solo has visto uno, y una sola vez.
    }
# Both were turned up once.
reason-first-both-seen-once =
    .a = Has visto las dos cartas con { $card-el }, una vez cada una.
    .b = Las dos cartas { $card-del } ya han salido, una vez cada una.
    .c = { $card-genero ->
        [f] Las dos { $card-plural } ya te han salido, una vez cada una.
       *[m] Los dos { $card-plural } ya te han salido, una vez cada uno.
    }
# One was turned up twice or more, the other never.
reason-first-often-and-never =
    .a = Has visto más de una vez una carta con { $card-el }, pero la otra nunca.
    .b = Una de las dos cartas { $card-del } ha salido al menos dos veces; la otra, ninguna.
    .c = { $card-genero ->
        [f] De las dos { $card-plural } solo has visto una, pero más de una vez.
       *[m] De los dos { $card-plural } solo has visto uno, pero más de una vez.
    }
# One was turned up twice or more, the other once.
reason-first-often-and-once =
    .a = Has visto más de una vez una carta con { $card-el }, y la otra una sola vez.
    .b = Una de las dos cartas { $card-del } ha salido al menos dos veces; la otra, solo una.
    .c = { $card-genero ->
        [f] Una de las dos { $card-plural } ya te ha salido más de una vez; la otra, una sola.
       *[m] Uno de los dos { $card-plural } ya te ha salido más de una vez; el otro, una sola.
    }
# Both were turned up twice or more.
reason-first-both-often =
    .a = Has visto más de una vez las dos cartas con { $card-el }.
    .b = Las dos cartas { $card-del } han salido al menos dos veces cada una.
    .c = { $card-genero ->
        [f] Las dos { $card-plural } ya te han salido más de una vez cada una.
       *[m] Los dos { $card-plural } ya te han salido más de una vez cada uno.
    }

## Reasons before a second card: the open card, and its partner

# The open card is up for the first time; its partner was never turned up.
reason-second-first-sight =
    .a = Es la primera vez que ves { $card-este }, y su pareja todavía no ha salido.
    .b = Esta carta con { $card-el } es nueva, y su pareja aún no la has visto.
    .c = { $card-genero ->
        [f] Esta es la primera { $card } que te sale: la otra todavía no la has visto.
       *[m] Este es el primer { $card } que te sale: el otro todavía no lo has visto.
    }
# The open card is up for the first time; its partner was turned up once.
reason-second-both-seen-once =
    .a = Esta carta con { $card-el } es nueva, pero su pareja ya la has visto una vez.
    .b = La otra carta { $card-del } ya ha salido una vez.
    .c = Es la primera vez que ves { $card-este }, pero ya te ha salido una vez { $card-genero ->
        [f] la otra.
       *[m] el otro.
    }
# The open card was turned up before; its partner never.
reason-second-often-and-never =
    .a = Esta carta con { $card-el } ya la habías visto, pero su pareja nunca.
    .b = Esta carta { $card-del } ya había salido; su pareja, todavía no.
    .c = Ya te había salido { $card-este }, pero no { $card-genero ->
        [f] la otra.
       *[m] el otro.
    }
# The open card was turned up before; its partner once.
reason-second-often-and-once =
    .a = Esta carta con { $card-el } ya la habías visto, y su pareja la has visto una vez.
    .b = Esta carta { $card-del } ya había salido, y su pareja ha salido una vez.
    .c = Ya te había salido { $card-este }, y una vez también { $card-genero ->
        [f] la otra.
       *[m] el otro.
    }
# The open card is up for the first time; its partner was turned up twice or more.
reason-second-open-once-mate-often =
    .a = Esta carta con { $card-el } es nueva, pero su pareja ya la has visto más de una vez.
    .b = La otra carta { $card-del } ya ha salido al menos dos veces.
    .c = Es la primera vez que ves { $card-este }, pero ya te ha salido más de una vez { $card-genero ->
        [f] la otra.
       *[m] el otro.
    }
# The open card was turned up before; its partner twice or more.
reason-second-both-often =
    .a = Has visto más de una vez las dos cartas con { $card-el }.
    .b = Esta carta { $card-del } y su pareja han salido al menos dos veces cada una.
    .c = { $card-genero ->
        [f] Las dos { $card-plural } te han salido más de una vez cada una.
       *[m] Los dos { $card-plural } te han salido más de una vez cada uno.
    }

## Reminders before a first card: said alone, without a place

# Neither card of the pair was ever turned up.
remind-first-nothing-known =
    .a = Hay una pareja que todavía no has visto.
    .b = Dos cartas iguales todavía no han salido.
# One card was turned up once, the other never.
remind-first-one-seen-once =
    .a = De las dos cartas con { $card-el } has visto una, una vez; la otra, todavía no.
    .b = Una de las dos cartas con { $card-el } ha salido una vez; la otra, todavía no.
# Both were turned up once.
remind-first-both-seen-once =
    .a = Ya has visto las dos cartas con { $card-el }.
    .b = Las dos cartas con { $card-el } ya han salido, una vez cada una.
# One was turned up twice or more, the other never.
remind-first-often-and-never =
    .a = De las dos cartas con { $card-el } has visto una más de una vez; la otra, nunca.
    .b = Una de las dos cartas con { $card-el } ha salido al menos dos veces; la otra, todavía no.
# One was turned up twice or more, the other once.
remind-first-often-and-once =
    .a = De las dos cartas con { $card-el } has visto una más de una vez; la otra, una sola vez.
    .b = Una de las dos cartas con { $card-el } ha salido al menos dos veces; la otra, una sola vez.
# Both were turned up twice or more.
remind-first-both-often =
    .a = Ya has visto las dos cartas con { $card-el }, más de una vez cada una.
    .b = Las dos cartas con { $card-el } ya han salido, al menos dos veces cada una.

## Reminders before a second card

# The open card is up for the first time; its partner was never turned up.
remind-second-first-sight =
    .a = Es la primera carta con { $card-el } que levantas; la otra todavía no la has visto.
    .b = La otra carta con { $card-el } todavía no ha salido.
# The open card is up for the first time; its partner was turned up once.
remind-second-both-seen-once =
    .a = La otra carta con { $card-el } ya la has visto una vez.
    .b = La otra carta con { $card-el } ya ha salido una vez.
# The open card was turned up before; its partner never.
remind-second-often-and-never =
    .a = Esta carta con { $card-el } ya la habías visto; la otra, todavía no.
    .b = Esta carta con { $card-el } ya había salido; la otra, todavía no.
# The open card was turned up before; its partner once.
remind-second-often-and-once =
    .a = Esta carta con { $card-el } ya la habías visto, y la otra la has visto una vez.
    .b = Esta carta con { $card-el } ya había salido, y la otra ha salido una vez.
# The open card is up for the first time; its partner was turned up twice or more.
remind-second-open-once-mate-often =
    .a = La otra carta con { $card-el } ya la has visto más de una vez.
    .b = La otra carta con { $card-el } ya ha salido al menos dos veces.
# The open card was turned up before; its partner twice or more.
remind-second-both-often =
    .a = Esta carta con { $card-el } ya la habías visto, y la otra la has visto más de una vez.
    .b = Esta carta con { $card-el } ya había salido, y la otra ha salido al menos dos veces.

## Places: a sentence may also stand alone, without a reason before it

point-first-column =
    .a = Prueba una carta de la columna { $column }.
    .b = Echa un vistazo a la columna { $column }.
    .c = Yo levantaría una carta en la columna { $column }.
point-first-row =
    .a = Prueba una carta de la fila { $row }.
    .b = Echa un vistazo a la fila { $row }.
    .c = Yo levantaría una carta en la fila { $row }.
point-first-card =
    .a = Prueba la carta de la fila { $row }, columna { $column }.
    .b = Echa un vistazo a la fila { $row }, columna { $column }.
    .c = Yo levantaría la carta de la fila { $row }, columna { $column }.
point-second-column =
    .a = Su pareja está en la columna { $column }.
    .b = Busca la otra en la columna { $column }.
    .c = La que falta la encuentras en la columna { $column }.
point-second-row =
    .a = Su pareja está en la fila { $row }.
    .b = Busca la otra en la fila { $row }.
    .c = La que falta la encuentras en la fila { $row }.
point-second-card =
    .a = Su pareja está en la fila { $row }, columna { $column }.
    .b = Busca la otra en la fila { $row }, columna { $column }.
    .c = La que falta la encuentras en la fila { $row }, columna { $column }.

## Comentarios después de una jugada, si la condición los tiene: ningún lugar, y nada sobre lo que se ha visto

# Después de encontrar una pareja.
praise =
    .a = ¡Muy bien, es una pareja!
    .b = Una pareja. ¡Estupendo!
    .c = Has encontrado una pareja. ¡Bien hecho!
# Después de una jugada fallida.
encouragement =
    .a = ¡Sigue así!
    .b = No hay pareja, por ahora. ¡Tú puedes!
    .c = Tómate todo el tiempo que necesites.
