### Every sentence on the screens and every one that is spoken outside a hint.
### Informal "tú", and nothing that tells whether the visitor, or the assistant, is a woman or a man.

language-name = Español

## Attract

attract-title = ¿Te acuerdas?
attract-line = Juega conmigo a encontrar las parejas.
attract-promise = Unos diez minutos. No hace falta tu nombre.
attract-start = Empezar
attract-trial = Prueba: no hay PIN. { $shortcut } para salir
attract-trial-keyless = Prueba: no hay PIN
attract-greeting =
    .a = ¡Hola! ¿Jugamos?
    .b = Aquí se esconden parejas. ¿Puedes encontrarlas todas?
    .c = Acércate, me gusta jugar.

## About the study

about-continue = Continuar

# Visitors who were here before, in a study that lets them come back.
return-offer = Ya he estado aquí
return-title = Escribe el código de tu tarjeta
return-line = Diez letras y cifras, como están en la tarjeta de tu última visita.
return-mistyped = Una letra o una cifra de este código no es correcta. Compáralo con tu tarjeta.
return-unknown = Aquí no se conoce este código. Compáralo con tu tarjeta o sigue como si fuera la primera vez.
return-go = Seguir
return-new = Es mi primera vez
return-welcome = ¡Qué bien que has vuelto! Podemos empezar tu nueva visita.
return-as-new = Aquí no se conoce este código. Puedes jugar igualmente, como si fuera la primera vez.

## Consent

consent-required = necesario
consent-optional = opcional
consent-agreed = de acuerdo
consent-missing = Si quieres participar, marca esta casilla.
# Over the boxes that are needed, as long as some of them have no tick: if there are no others, and if others follow.
consent-to-go =
    { $number ->
        [one] Para participar, marca la casilla
       *[other] Para participar, marca las { $number } casillas
    }
consent-first =
    { $number ->
        [one] Para participar, marca esta casilla
       *[other] Para participar, marca estas { $number }
    }
# The same boxes, below the words of the answer that needs them.
consent-to-go-line =
    { $number ->
        [one] Marca la casilla.
       *[other] Marca las { $number } casillas.
    }
consent-first-line =
    { $number ->
        [one] Marca la primera casilla.
       *[other] Marca las { $number } primeras casillas.
    }
# In its place, once all of them have one. It must favour neither answer.
consent-ready = Ya está. Ahora elige abajo.
consent-agree = Participo
# What follows, below each answer. Both lines are about as long.
consent-agree-line = Guardamos tus datos.
consent-decline = Solo jugar
consent-decline-line = No guardamos nada sobre ti.
consent-more = Leer todo
consent-less = Mostrar menos

## Age

age-question = ¿Has cumplido { $adult } años?
age-line = Puedes jugar en cualquier caso. Si aún no los tienes, no guardamos nada sobre ti.
age-older = Tengo { $adult } años o más
age-younger = Tengo menos de { $adult } años
age-yes = Sí
age-no = No

## Introduction

introduction-title = Cómo se juega
introduction-speech =
    .a = ¡Hola, me alegro de conocerte! Hay { $cards } cartas, y cada dibujo está dos veces. Encuentra todas las parejas. ¡Mucha suerte!
    .b = ¡Hola, qué bien que estés aquí! { $cards } cartas, { $pairs } parejas: encuéntralas todas. ¡Que te diviertas!
introduction-speech-alone =
    .a = ¡Hola, me alegro de conocerte! Hay { $cards } cartas, y cada dibujo está dos veces. Encuentra todas las parejas. Yo te miro jugar. ¡Mucha suerte!
    .b = ¡Hola, qué bien que estés aquí! { $cards } cartas, { $pairs } parejas: encuéntralas todas. ¡Que te diviertas!
introduction-turn =
    Levanta dos cartas.
    Recuerda dónde está cada dibujo.
introduction-match =
    Las parejas quedan.
    Dos cartas distintas se tapan otra vez.
introduction-help =
    Yo doy pistas.
    Tú decides si las sigues.
introduction-continue = Empecemos

## Practice

practice-title = Práctica
practice-skip = Ir al juego
practice-turn = Da la vuelta a cualquier carta.
practice-speech =
    .a = Primero practicamos un poco: todavía no cuenta nada, y puedes pasar al juego cuando quieras. { practice-turn }
    .b = Es una breve práctica: cuando tengas bastante, pasa al juego. { practice-turn }

## Game

game-pairs = { $found } de { $all } parejas
game-moves =
    { $moves ->
        [one] 1 jugada
       *[other] { $moves } jugadas
    }
game-begin = Te toca. Da la vuelta a cualquier carta.
game-second = Ahora una segunda carta
practice-second = Ahora da la vuelta a una segunda carta.
practice-no-pair = No es una pareja.
practice-turning-back = Un momento, las cartas se vuelven a tapar.
practice-pair = ¡Una pareja!
game-found = ¡Todas encontradas!
game-wait-speaking = Un momento, tengo una pista para ti
game-wait-turning-back = Un momento, las cartas se vuelven a tapar
game-closed-card = Carta tapada, fila { $row }, columna { $column }
game-open-card = { $card }, fila { $row }, columna { $column }

## Result

result-title = ¡Todas las parejas!
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
result-hints-label = Pistas
result-line = Aquí están, en el orden en que las encontraste.
result-continue = Continuar
result-speech-few =
    .a = ¡Vaya, qué rapidez! Una gran partida.
    .b = ¡Qué pocas jugadas! Una partida brillante.
result-speech-some =
    .a = ¡Muy bien jugado! Ha sido una buena partida.
    .b = ¡Qué bonita partida! Has jugado bien.
result-speech-many =
    .a = Has seguido hasta la última. ¡Qué divertido!
    .b = ¡Qué divertido! Me ha gustado jugar contigo.

## Questions

form-title = Algunas preguntas
form-calm = Tómate tu tiempo. No hay respuestas incorrectas.
form-progress = Página { $number } de { $all }
form-next = Siguiente
# Beside the way on, as long as answers are missing.
form-to-go =
    { $number ->
        [one] Falta una respuesta
       *[other] Faltan { $number } respuestas
    }
form-skip = Seguir sin responder
form-not-applicable = No procede
form-missing = Responde primero a esta pregunta, por favor.
form-skipped = Has dejado esta pregunta. Puedes omitirla.
form-wrong-number = Escribe un número entero de { $lowest } a { $highest }.
form-refused = Contiene un salto de línea u otro carácter que no se puede guardar. Escríbelo de nuevo, por favor.
form-range = de { $lowest } a { $highest }
form-none = Aún no se ha elegido nada
form-touch = Toca la línea.
form-type = Toca aquí para escribir
form-number = Toca aquí
form-less = Uno menos
form-more = Uno más
# Beside the helper's back, while visitors rate it.
form-turned = No estoy mirando.

## The keyboard on the screen

keyboard-shift = Mayúsculas
keyboard-delete = Borrar
keyboard-space = Espacio
keyboard-done = Hecho
keyboard-letters = Letras
keyboard-accents = Letras con acento
keyboard-signs = Signos

## Debrief

debrief-take-home = Para llevar a casa
debrief-code = Haz una foto de este código
debrief-scan-letter = Un mensaje para nosotros
debrief-scan-summary = Tu código y el estudio
debrief-scan = Tu código para escanear
debrief-withdraw-by-mail = Para que borremos tus datos, envía este código a { $contact }
debrief-withdraw-here = Para que borremos tus datos, di este código a las personas de esta mesa.
debrief-return = Con este código puedes volver otro día.
debrief-questions = Preguntas sobre el estudio: { $contact }
debrief-subject = Por favor, borren mis datos: { $code }
debrief-continue = Continuar

## Thanks

thanks-title = ¡Gracias!
thanks-continue = Terminar
thanks-speech =
    .a = Ha sido divertido jugar contigo. ¡Hasta la vista!
    .b = Ha sido un placer. ¡Que tengas un buen día!

## Everywhere

scroll-more = Hay más abajo
still-there-title = ¿Sigues ahí?
still-there-line = Si no, me preparo para la siguiente persona.
still-there-yes = Sigo aquí
# below the number of seconds that are left: the first where it is 1
still-there-second = segundo
still-there-seconds = segundos
pause-title = Una breve pausa
pause-line = Las personas de esta mesa necesitan un momento.
pause-kept = No se pierde nada. Seguirá por sí solo.
# time: when the people at the table are back, such as 14:05
pause-back = Volvemos a las { $time }.
pause-then = Entonces podrás jugar.
pause-help = Pide ayuda a las personas de esta mesa, por favor.
wait-title = Un momento, por favor
wait-line = Continúa por sí solo.
replay-line = Hasta dónde se ha reproducido
replay-differs = distinto de lo registrado

## La esquina: lo que se puede hacer en cualquier pantalla

control-stop = Parar
control-language = Idioma
control-text-size = Tamaño del texto
control-sound-on = Activar el sonido
control-sound-off = Quitar el sonido
control-say-again = Repetir
control-back = Atrás
stop-title = ¿Quieres parar?
stop-line-nothing = No se guarda nada sobre ti.
stop-line-kept = Si paras, lo registrado se conserva. Con tu código puedes pedir que se borre.
stop-line-deleted = Lo registrado hasta ahora se borra.
stop-code = Haz una foto de tu código
stop-yes = Parar ahora
stop-no = Seguir
