### Every sentence on the screens and every one that is spoken outside a hint.
### Informal "tu", and nothing that tells whether the visitor, or the assistant, is a woman or a man.

language-name = Italiano

## Attract

attract-title = Ti ricordi?
attract-line = Gioca con me a trovare le coppie.
attract-promise = Circa dieci minuti. Il nome non serve.
attract-start = Inizia
attract-trial = Prova: nessun PIN impostato. { $shortcut } per uscire
attract-trial-keyless = Prova: nessun PIN impostato
attract-greeting =
    .a = Ciao! Giochiamo?
    .b = Qui si nascondono delle coppie. Riesci a trovarle tutte?
    .c = Avvicinati, mi piace giocare.

## About the study

about-continue = Continua

# Visitors who were here before, in a study that lets them come back.
return-offer = Non è la mia prima volta qui
return-title = Scrivi il codice della tua scheda
return-line = Dieci lettere e cifre, come sulla scheda della tua ultima visita.
return-mistyped = Una lettera o una cifra di questo codice non è giusta. Confrontalo con la tua scheda.
return-unknown = Qui questo codice non è conosciuto. Confrontalo con la tua scheda, oppure continua come se fosse la prima volta.
return-go = Continua
return-new = È la prima volta
return-welcome = Che bello rivederti! Possiamo cominciare la tua nuova visita.
return-as-new = Qui questo codice non è conosciuto. Puoi giocare lo stesso, come se fosse la prima volta.

## Consent

consent-required = necessario
consent-optional = facoltativo
consent-agreed = d'accordo
consent-missing = Se vuoi partecipare, spunta questa casella.
# Over the boxes that are needed, as long as some of them have no tick: if there are no others, and if others follow.
consent-to-go =
    { $number ->
        [one] Per partecipare, spunta la casella
       *[other] Per partecipare, spunta le { $number } caselle
    }
consent-first =
    { $number ->
        [one] Per partecipare, spunta questa casella
       *[other] Per partecipare, spunta queste { $number }
    }
# The same boxes, below the words of the answer that needs them.
consent-to-go-line =
    { $number ->
        [one] Spunta la casella.
       *[other] Spunta le { $number } caselle.
    }
consent-first-line =
    { $number ->
        [one] Spunta la prima casella.
       *[other] Spunta le prime { $number } caselle.
    }
# In its place, once all of them have one. It must favour neither answer.
consent-ready = Tutto qui. Ora scegli qui sotto.
consent-agree = Partecipo
# What follows, below each answer. Both lines are about as long.
consent-agree-line = Conserviamo i tuoi dati.
consent-decline = Solo giocare
consent-decline-line = Non conserviamo nulla su di te.
consent-more = Leggi tutto
consent-less = Mostra meno

## Age

age-question = Hai compiuto { $adult } anni?
age-line = Puoi giocare in ogni caso. Se non li hai ancora, non conserviamo nulla su di te.
age-older = Ho { $adult } anni o più
age-younger = Ho meno di { $adult } anni
age-yes = Sì
age-no = No

## Introduction

introduction-title = Come si gioca
introduction-speech =
    .a = Ciao, che piacere conoscerti! Ci sono { $cards } carte, e ogni figura c'è due volte. Trova tutte le coppie. In bocca al lupo!
    .b = Ciao, che bello averti qui! { $cards } carte, { $pairs } coppie: trovale tutte. Buon divertimento!
introduction-speech-alone =
    .a = Ciao, che piacere conoscerti! Ci sono { $cards } carte, e ogni figura c'è due volte. Trova tutte le coppie. Io ti guardo giocare. In bocca al lupo!
    .b = Ciao, che bello averti qui! { $cards } carte, { $pairs } coppie: trovale tutte. Buon divertimento!
introduction-turn =
    Gira due carte.
    Ricorda dov'è ogni figura.
introduction-match =
    Le coppie restano.
    Due carte diverse si coprono di nuovo.
introduction-help =
    Io suggerisco.
    Decidi tu se seguirli.
introduction-continue = Cominciamo

## Practice

practice-title = Prova
practice-skip = Vai al gioco
practice-turn = Scopri una carta qualsiasi.
practice-speech =
    .a = Prima facciamo una prova: non conta ancora nulla, e puoi passare al gioco quando vuoi. { practice-turn }
    .b = È una breve prova: quando ne hai abbastanza, passa al gioco. { practice-turn }

## Game

game-pairs =
    { $found ->
        [one] 1 coppia su { $all }
       *[other] { $found } coppie su { $all }
    }
game-moves =
    { $moves ->
        [one] 1 mossa
       *[other] { $moves } mosse
    }
game-begin = Tocca a te. Scopri una carta qualsiasi.
game-second = Ora una seconda carta
practice-second = Ora scopri una seconda carta.
practice-no-pair = Non è una coppia.
practice-turning-back = Un momento, le carte si coprono di nuovo.
practice-pair = Una coppia!
game-found = Trovate tutte!
game-wait-speaking = Un momento, ho un suggerimento per te
game-wait-turning-back = Un momento, le carte si coprono di nuovo
game-closed-card = Carta coperta, riga { $row }, colonna { $column }
game-open-card = { $card }, riga { $row }, colonna { $column }

## Result

result-title = Tutte le coppie trovate!
result-moves =
    { $moves ->
        [one] in 1 mossa
       *[other] in { $moves } mosse
    }
result-time =
    { $minutes ->
        [0] { $seconds } secondi
       *[other] { $minutes } min { $seconds } s
    }
result-time-label = Tempo
result-moves-label = Mosse
result-pairs-label = Coppie
result-hints-label = Suggerimenti
result-line = Eccole, nell'ordine in cui le hai trovate.
result-continue = Continua
result-speech-few =
    .a = Wow, che velocità! Bellissima partita.
    .b = Così poche mosse! Davvero una gran partita.
result-speech-some =
    .a = Bella partita! Hai giocato bene.
    .b = Che bella partita. Complimenti!
result-speech-many =
    .a = Hai continuato fino all'ultima. È stato divertente!
    .b = È stato divertente! Mi è piaciuto giocare con te.

## Questions

form-title = Alcune domande
form-calm = Prenditi il tempo che vuoi. Non ci sono risposte sbagliate.
form-progress = Pagina { $number } di { $all }
form-next = Avanti
# Beside the way on, as long as answers are missing.
form-to-go =
    { $number ->
        [one] Manca una risposta
       *[other] Mancano { $number } risposte
    }
form-skip = Continua senza
form-not-applicable = Non si applica
form-missing = Rispondi prima a questa domanda, per favore.
form-skipped = Hai lasciato questa domanda. Puoi anche saltarla.
form-wrong-number = Scrivi un numero intero da { $lowest } a { $highest }.
form-refused = Contiene un a capo o un altro carattere che non si può salvare. Scrivilo di nuovo, per favore.
form-range = da { $lowest } a { $highest }
form-none = Non è ancora scelto nulla
form-touch = Tocca la linea.
form-type = Tocca qui per scrivere
form-number = Tocca qui
form-less = Uno in meno
form-more = Uno in più
# Beside the helper's back, while visitors rate it.
form-turned = Non guardo.

## The keyboard on the screen

keyboard-shift = Maiuscole
keyboard-delete = Cancella
keyboard-space = Spazio
keyboard-done = Fatto
keyboard-letters = Lettere
keyboard-accents = Lettere accentate
keyboard-signs = Segni

## Debrief

debrief-take-home = Da portare a casa
debrief-code = Fotografa questo codice
debrief-scan-letter = Un messaggio per noi
debrief-scan-summary = Il codice e lo studio
debrief-scan = Il codice da inquadrare
debrief-withdraw-by-mail = Per far cancellare i tuoi dati, manda questo codice a { $contact }
debrief-withdraw-here = Per far cancellare i tuoi dati, di' questo codice alle persone a questo tavolo.
debrief-return = Con questo codice puoi tornare un altro giorno.
debrief-questions = Domande sullo studio: { $contact }
debrief-subject = Per favore, cancellate i miei dati: { $code }
debrief-continue = Continua

## Thanks

thanks-title = Grazie!
thanks-continue = Fine
thanks-speech =
    .a = È stato divertente giocare con te. Arrivederci!
    .b = È stato un piacere. Buona giornata!

## Everywhere

scroll-more = Sotto c'è altro
still-there-title = Ci sei ancora?
still-there-line = Altrimenti mi preparo per la prossima persona.
still-there-yes = Sono ancora qui
# below the number of seconds that are left: the first where it is 1
still-there-second = secondo
still-there-seconds = secondi
pause-title = Una breve pausa
pause-line = Le persone a questo tavolo hanno bisogno di un momento.
pause-kept = Non si perde nulla. Riprende da solo.
# time: when the people at the table are back, such as 14:05
pause-back = Si torna alle { $time }.
pause-then = Allora potrai giocare.
pause-help = Chiedi aiuto alle persone a questo tavolo.
wait-title = Un momento, per favore
wait-line = Continua da solo.
replay-line = Fin dove è arrivata la riproduzione
replay-differs = diverso dalla registrazione

## L'angolo: ciò che chi gioca può fare su ogni schermata

control-stop = Smetti
control-language = Lingua
control-text-size = Dimensione del testo
control-sound-on = Attiva l'audio
control-sound-off = Disattiva l'audio
control-say-again = Ripeti
control-back = Indietro
stop-title = Vuoi smettere?
stop-line-nothing = Non viene conservato nulla su di te.
stop-line-kept = Se smetti, quanto registrato resta conservato. Con il tuo codice puoi farlo cancellare.
stop-line-deleted = Quanto registrato finora viene cancellato.
stop-code = Fotografa il tuo codice
stop-yes = Smetti ora
stop-no = Continua
