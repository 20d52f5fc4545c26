### Every sentence on the screens and every one that is spoken outside a hint.
### Informal "tú", and nothing that tells whether the visitor, or the assistant, is a woman or a man.

## Attract

attract-title = ¿Te acuerdas?
attract-line = Juega conmigo a encontrar las parejas. Se tarda unos cinco minutos.
attract-start = Empezar

## Introduction

introduction-title = ¡Hola!
introduction-speech =
    .a = ¡Hola, me alegro de conocerte! Hay veinticuatro cartas, y cada dibujo está dos veces. Levanta las cartas de dos en dos y encuentra todas las parejas. De vez en cuando te echaré una mano. ¡Mucha suerte!
    .b = ¡Hola, qué bien que estés aquí! Veinticuatro cartas, doce parejas. Levanta las cartas de dos en dos hasta encontrarlas todas. A veces te daré una pista. ¡Que te diviertas!
introduction-turn = Da la vuelta a dos cartas cada vez.
introduction-match = Dos iguales se quedan a la vista. Dos distintas se vuelven a tapar.
introduction-help = De vez en cuando te doy una pista. Tú decides si la sigues.
introduction-continue = Empecemos

## Game

game-pairs = { $found } de { $all } parejas
game-moves =
    { $moves ->
        [one] 1 jugada
       *[other] { $moves } jugadas
    }
game-wait-speaking = Un momento, tengo una pista para ti
game-wait-turning-back = Un momento, las cartas se vuelven a tapar
game-closed-card = Carta tapada, fila { $row }, columna { $column }
game-open-card = { $card }, fila { $row }, columna { $column }

## Result

result-title = ¡Has encontrado todas las parejas!
result-moves =
    { $moves ->
        [one] en 1 jugada
       *[other] en { $moves } jugadas
    }
result-time =
    { $minutes ->
        [0] { $seconds } segundos
       *[other] { $minutes } min { $seconds } s
    }
result-time-label = Tiempo
result-moves-label = Jugadas
result-pairs-label = Parejas
result-continue = Tres preguntas breves
result-speech-few =
    .a = ¡Vaya memoria! Solo { $moves } jugadas.
    .b = ¡En { $moves } jugadas! Ha sido rapidísimo.
result-speech-some =
    .a = ¡Muy bien! Has necesitado { $moves } jugadas.
    .b = Buena partida, { $moves } jugadas.
result-speech-many =
    .a = ¡Lo has conseguido, todas las parejas! Gracias por jugar conmigo.
    .b = Ahí están, las doce parejas. ¡Qué divertido!

## Questions

questions-progress = Pregunta { $number } de { $all }
questions-lowest = nada
questions-highest = muchísimo
questions-next = Siguiente
questions-skip = Saltar
questions-finish = Terminar
question-closing-enjoyed = ¿Te ha gustado el juego?
question-closing-helped = ¿Te han ayudado las pistas a encontrar las parejas?
question-closing-understood = ¿Te ha parecido que quien te ayudaba sabía lo que recordabas?

## Everywhere

still-there-title = ¿Sigues ahí?
still-there-line = Si no, me preparo para la siguiente persona.
still-there-yes = Sigo aquí
pause-title = Una breve pausa
pause-line = Pide ayuda a las personas de esta mesa, por favor.
