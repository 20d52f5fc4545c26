### Every sentence on the screens and every one that is spoken outside a hint.

language-name = Deutsch

## Attract

attract-title = Weißt du noch, wo?
attract-line = Spiel mit mir ein Spiel mit Paaren.
attract-promise = Etwa zehn Minuten. Ohne deinen Namen.
attract-start = Start
attract-trial = Probe: Es ist keine PIN gesetzt. { $shortcut } beendet
attract-trial-keyless = Probe: Es ist keine PIN gesetzt
attract-greeting =
    .a = Hallo! Spielen wir?
    .b = Hier sind Paare versteckt. Findest du alle?
    .c = Komm näher, ich spiele gern.

## About the study

about-continue = Weiter

# Visitors who were here before, in a study that lets them come back.
return-offer = Ich war schon einmal hier
return-title = Tippe den Code von deiner Karte ein
return-line = Zehn Buchstaben und Ziffern, so wie sie auf der Karte deines letzten Besuchs stehen.
return-mistyped = Ein Buchstabe oder eine Ziffer dieses Codes stimmt nicht. Bitte vergleiche ihn mit deiner Karte.
return-unknown = Diesen Code kennen wir hier nicht. Bitte vergleiche ihn mit deiner Karte, oder spiele wie beim ersten Mal.
return-go = Weiter
return-new = Ich bin neu hier
return-welcome = Schön, dass du wieder da bist! Für deinen nächsten Besuch ist alles bereit.
return-as-new = Diesen Code kennen wir hier nicht. Du kannst trotzdem spielen, wie beim ersten Mal.

## Consent

consent-required = nötig
consent-optional = freiwillig
consent-agreed = einverstanden
consent-missing = Bitte kreuze das an, wenn du teilnehmen möchtest.
# Over the boxes that are needed, as long as some of them have no tick: if there are no others, and if others follow.
consent-to-go =
    { $number ->
        [one] Zum Mitmachen kreuze das Kästchen an
       *[other] Zum Mitmachen kreuze die { $number } Kästchen an
    }
consent-first =
    { $number ->
        [one] Zum Mitmachen kreuze dieses Kästchen an
       *[other] Zum Mitmachen kreuze diese { $number } an
    }
# The same boxes, below the words of the answer that needs them.
consent-to-go-line =
    { $number ->
        [one] Kreuze das Kästchen an.
       *[other] Kreuze die { $number } Kästchen an.
    }
consent-first-line =
    { $number ->
        [one] Kreuze das erste Kästchen an.
       *[other] Kreuze die ersten { $number } Kästchen an.
    }
# In its place, once all of them have one. It must favour neither answer.
consent-ready = Das ist alles. Wähle jetzt unten.
consent-agree = Ich nehme teil
# What follows, below each answer. Both lines are about as long.
consent-agree-line = Deine Daten werden gespeichert.
consent-decline = Nur spielen
consent-decline-line = Nichts über dich wird gespeichert.
consent-more = Alles lesen
consent-less = Weniger zeigen

## Age

age-question = Bist du { $adult } oder älter?
age-line = Spielen kannst du so oder so. Wenn du jünger bist, wird nichts über dich gespeichert.
age-older = Ich bin { $adult } oder älter
age-younger = Ich bin jünger als { $adult }
age-yes = Ja
age-no = Nein

## Introduction

introduction-title = So wird gespielt
introduction-speech =
    .a = Hallo, schön, dass du da bist! Es gibt { $cards } Karten, und jedes Bild ist zweimal da. Finde alle Paare. Viel Glück!
    .b = Hallo, ich freue mich, dass du hier bist! { $cards } Karten, { $pairs } Paare: Finde sie alle. Viel Spaß!
introduction-speech-alone =
    .a = Hallo, schön, dass du da bist! Es gibt { $cards } Karten, und jedes Bild ist zweimal da. Finde alle Paare. Ich schaue zu. Viel Glück!
    .b = Hallo, ich freue mich, dass du hier bist! { $cards } Karten, { $pairs } Paare: Finde sie alle. Viel Spaß!
introduction-turn =
    Dreh zwei um.
    Merk dir, wo jedes Bild ist.
introduction-match =
    Paare bleiben.
    Zwei verschiedene drehen sich zurück.
introduction-help =
    Ich gebe Tipps.
    Ob du ihnen folgst, entscheidest du.
introduction-continue = Ich bin bereit

## Practice

practice-title = Übung
practice-skip = Zum Spiel
practice-turn = Dreh irgendeine Karte um.
practice-speech =
    .a = Wir üben erst einmal: Noch zählt nichts, und du kannst zum Spiel weitergehen, wann du möchtest. { practice-turn }
    .b = Das ist eine kurze Übung: Wenn es dir reicht, geh weiter zum Spiel. { practice-turn }

## Game

game-pairs = { $found } von { $all } Paaren
game-moves =
    { $moves ->
        [one] 1 Zug
       *[other] { $moves } Züge
    }
game-begin = Du bist dran. Dreh irgendeine Karte um.
game-second = Jetzt eine zweite Karte
practice-second = Dreh jetzt eine zweite Karte um.
practice-no-pair = Kein Paar.
practice-turning-back = Einen Moment, die Karten drehen sich um.
practice-pair = Ein Paar!
game-found = Alle gefunden!
game-wait-speaking = Einen Moment, ich habe einen Tipp für dich
game-wait-turning-back = Einen Moment, die Karten drehen sich um
game-closed-card = Verdeckte Karte, Reihe { $row }, Spalte { $column }
game-open-card = { $card }, Reihe { $row }, Spalte { $column }

## Result

result-title = Alle Paare gefunden!
result-moves =
    { $moves ->
        [one] in 1 Zug
       *[other] in { $moves } Zügen
    }
result-time =
    { $minutes ->
        [0] { $seconds } Sekunden
       *[other] { $minutes } min { $seconds } s
    }
result-time-label = Zeit
result-moves-label = Züge
result-pairs-label = Paare
result-hints-label = Tipps
result-line = Hier sind sie in der Reihenfolge, in der du sie gefunden hast.
result-continue = Weiter
result-speech-few =
    .a = Wow, das ging schnell! Ein tolles Spiel.
    .b = So wenige Züge! Das war großartig.
result-speech-some =
    .a = Schön gespielt! Das war ein gutes Spiel.
    .b = Was für ein schönes Spiel. Gut gemacht!
result-speech-many =
    .a = Du bist bis zum letzten drangeblieben. Das hat Spaß gemacht!
    .b = Das hat Spaß gemacht! Ich habe gern mit dir gespielt.

## Questions

form-title = Ein paar Fragen
form-calm = Lass dir Zeit. Es gibt keine falschen Antworten.
form-progress = Seite { $number } von { $all }
form-next = Weiter
# Beside the way on, as long as answers are missing.
form-to-go =
    { $number ->
        [one] Noch eine Antwort
       *[other] Noch { $number } Antworten
    }
form-skip = Ohne Antwort weiter
form-not-applicable = Trifft nicht zu
form-missing = Bitte beantworte zuerst diese Frage.
form-skipped = Diese Frage ist noch offen. Du darfst sie auslassen.
form-wrong-number = Bitte gib eine ganze Zahl von { $lowest } bis { $highest } ein.
form-refused = Darin ist ein Zeilenumbruch oder ein anderes Zeichen, das nicht gespeichert werden kann. Bitte gib es noch einmal ein.
form-range = von { $lowest } bis { $highest }
form-none = Noch nichts gewählt
form-touch = Tippe auf die Linie.
form-type = Zum Schreiben hier tippen
form-number = Hier tippen
form-less = Eins weniger
form-more = Eins mehr
# Beside the helper's back, while visitors rate it.
form-turned = Ich schaue nicht hin.

## The keyboard on the screen

keyboard-shift = Großbuchstaben
keyboard-delete = Löschen
keyboard-space = Leerzeichen
keyboard-done = Fertig
keyboard-letters = Buchstaben
keyboard-accents = Buchstaben mit Akzent
keyboard-signs = Zeichen

## Debrief

debrief-take-home = Zum Mitnehmen
debrief-code = Fotografiere diesen Code
debrief-scan-letter = Eine Nachricht an uns
debrief-scan-summary = Dein Code und die Studie
debrief-scan = Dein Code zum Scannen
debrief-withdraw-by-mail = Um deine Daten löschen zu lassen, sende diesen Code an { $contact }
debrief-withdraw-here = Um deine Daten löschen zu lassen, nenne diesen Code den Leuten an diesem Tisch.
debrief-return = Mit diesem Code kannst du an einem anderen Tag wiederkommen.
debrief-questions = Fragen zur Studie: { $contact }
debrief-subject = Bitte meine Daten löschen: { $code }
debrief-continue = Weiter

## Thanks

thanks-title = Danke!
thanks-continue = Fertig
thanks-speech =
    .a = Es hat Spaß gemacht, mit dir zu spielen. Auf Wiedersehen!
    .b = Das war mir eine Freude. Einen schönen Tag noch!

## Everywhere

scroll-more = Unten geht es weiter
still-there-title = Bist du noch da?
still-there-line = Wenn nicht, mache ich alles für das nächste Spiel bereit.
still-there-yes = Ich bin noch da
still-there-second = Sekunde
still-there-seconds = Sekunden
pause-title = Eine kurze Pause
pause-line = Die Leute an diesem Tisch brauchen einen Moment.
pause-kept = Nichts geht verloren. Es geht von selbst weiter.
# time: when the people at the table are back, such as 14:05
pause-back = Um { $time } geht es weiter.
pause-then = Dann kannst du spielen.
pause-help = Bitte frag die Leute an diesem Tisch um Hilfe.
wait-title = Einen Moment bitte
wait-line = Es geht von selbst weiter.
replay-line = Wie weit es abgespielt ist
replay-differs = weicht von der Aufzeichnung ab

## The corner: what a visitor may do on every screen

control-stop = Aufhören
control-language = Sprache
control-text-size = Textgröße
control-sound-on = Ton einschalten
control-sound-off = Ton ausschalten
control-say-again = Noch einmal sagen
control-back = Zurück
stop-title = Möchtest du aufhören?
stop-line-nothing = Über dich wird nichts gespeichert.
stop-line-kept = Wenn du aufhörst, bleibt gespeichert, was aufgezeichnet wurde. Mit deinem Code kannst du es löschen lassen.
stop-line-deleted = Was bisher aufgezeichnet wurde, wird gelöscht.
stop-code = Fotografiere deinen Code
stop-yes = Jetzt aufhören
stop-no = Weitermachen
