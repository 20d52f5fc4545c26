### Every sentence on the screens and every one that is spoken outside a hint.
### Informal "tu", and nothing that tells whether the visitor, or the assistant, is a woman or a man.

## Attract

attract-title = Ti ricordi?
attract-line = Gioca con me a trovare le coppie. Ci vogliono circa cinque minuti.
attract-start = Inizia

## Introduction

introduction-title = Ciao!
introduction-speech =
    .a = Ciao, che piacere conoscerti! Ci sono ventiquattro carte, e ogni figura c'è due volte. Gira due carte alla volta e trova tutte le coppie. Ogni tanto ti darò una mano. In bocca al lupo!
    .b = Ciao, che bello averti qui! Ventiquattro carte, dodici coppie. Gira due carte alla volta, finché non le hai trovate tutte. Qualche volta ti darò un suggerimento. Buon divertimento!
introduction-turn = Gira due carte alla volta.
introduction-match = Due carte uguali restano scoperte. Due diverse si coprono di nuovo.
introduction-help = Ogni tanto ti do un suggerimento. Sta a te decidere se seguirlo.
introduction-continue = Cominciamo

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
game-wait-speaking = Un momento, ho un suggerimento per te
game-wait-turning-back = Un momento, le carte si coprono di nuovo
game-closed-card = Carta coperta, riga { $row }, colonna { $column }
game-open-card = { $card }, riga { $row }, colonna { $column }

## Result

result-title = Hai trovato tutte le coppie!
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
result-continue = Tre brevi domande
result-speech-few =
    .a = Wow, che memoria! Solo { $moves } mosse.
    .b = In { $moves } mosse! È stato davvero veloce.
result-speech-some =
    .a = Complimenti! Ti sono servite { $moves } mosse.
    .b = Bella partita, { $moves } mosse.
result-speech-many =
    .a = Ce l'hai fatta, hai trovato tutte le coppie! Grazie per aver giocato con me.
    .b = Eccole qua, tutte e dodici le coppie. È stato divertente!

## Questions

questions-progress = Domanda { $number } di { $all }
questions-lowest = per niente
questions-highest = moltissimo
questions-next = Avanti
questions-skip = Salta
questions-finish = Fine
question-closing-enjoyed = Ti è piaciuto il gioco?
question-closing-helped = I suggerimenti ti hanno aiutato a trovare le coppie?
question-closing-understood = Secondo te, chi ti aiutava sapeva che cosa ricordavi?

## Everywhere

still-there-title = Ci sei ancora?
still-there-line = Altrimenti mi preparo per la prossima persona.
still-there-yes = Sono ancora qui
pause-title = Una breve pausa
pause-line = Chiedi aiuto alle persone a questo tavolo.
