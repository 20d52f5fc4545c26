### Every sentence on the screens and every one that is spoken outside a hint.

language-name = English

## Attract

attract-title = Do you remember?
attract-line = Play a game of pairs with me.
attract-promise = About ten minutes. No name needed.
attract-start = Start
attract-trial = Trial: no PIN is set. { $shortcut } leaves
attract-trial-keyless = Trial: no PIN is set
attract-greeting =
    .a = Hello! Shall we play?
    .b = Pairs are hidden here. Can you find them all?
    .c = Come closer, I like to play.

## About the study

about-continue = Continue

# Visitors who were here before, in a study that lets them come back.
return-offer = I have been here before
return-title = Type the code from your card
return-line = Ten letters and digits, as they stand on the card of your last visit.
return-mistyped = A letter or a digit of this code is not right. Please compare it with your card.
return-unknown = This code is not known here. Please compare it with your card, or go on as a new player.
return-go = Go on
return-new = I am new here
return-welcome = Welcome back! Everything is ready for your next visit.
return-as-new = This code is not known here. You can play all the same, as a new player.

## Consent

consent-required = needed
consent-optional = optional
consent-agreed = agreed
consent-missing = Please tick this box if you want to take part.
# Over the boxes that are needed, as long as some of them have no tick: if there are no others, and if others follow.
consent-to-go =
    { $number ->
        [one] To take part, tick the box
       *[other] To take part, tick the { $number } boxes
    }
consent-first =
    { $number ->
        [one] To take part, tick this box
       *[other] To take part, tick these { $number }
    }
# The same boxes, below the words of the answer that needs them.
consent-to-go-line =
    { $number ->
        [one] Tick the box.
       *[other] Tick the { $number } boxes.
    }
consent-first-line =
    { $number ->
        [one] Tick the first box.
       *[other] Tick the first { $number } boxes.
    }
# In its place, once all of them have one. It must favour neither answer.
consent-ready = All set. Now choose below.
consent-agree = I take part
# What follows, below each answer. Both lines are about as long.
consent-agree-line = Your data are stored.
consent-decline = Just play
consent-decline-line = Nothing about you is stored.
consent-more = Read all of it
consent-less = Show less

## Age

age-question = Are you { $adult } or older?
age-line = You can play either way. If you are younger, nothing about you is stored.
age-older = I am { $adult } or older
age-younger = I am younger than { $adult }
age-yes = Yes
age-no = No

## Introduction

introduction-title = How to play
introduction-speech =
    .a = Hello, nice to meet you! There are { $cards } cards, and every picture is there twice. Find all the pairs. Good luck!
    .b = Hello, I am glad you are here! { $cards } cards, { $pairs } pairs: find them all. Have fun!
introduction-speech-alone =
    .a = Hello, nice to meet you! There are { $cards } cards, and every picture is there twice. Find all the pairs. I will watch. Good luck!
    .b = Hello, I am glad you are here! { $cards } cards, { $pairs } pairs: find them all. Have fun!
introduction-turn =
    Turn two cards.
    Remember where each picture is.
introduction-match =
    Pairs stay open.
    Two different cards turn back.
introduction-help =
    I give hints.
    You decide whether to take them.
introduction-continue = I am ready

## Practice

practice-title = Practice
practice-skip = To the game
practice-turn = Turn over any card.
practice-speech =
    .a = Let us practise first: nothing counts yet, and you can go on to the game whenever you like. { practice-turn }
    .b = This is a short practice: when you have had enough, go on to the game. { practice-turn }

## Game

game-pairs = { $found } of { $all } pairs
game-moves =
    { $moves ->
        [one] 1 move
       *[other] { $moves } moves
    }
game-begin = It is your turn. Turn over any card.
game-second = Now a second card
practice-second = Now turn over a second card.
practice-no-pair = Not a pair.
practice-turning-back = One moment, the cards turn back.
practice-pair = A pair!
game-found = All found!
game-wait-speaking = One moment, I have a hint for you
game-wait-turning-back = One moment, the cards turn back
game-closed-card = Closed card, row { $row }, column { $column }
game-open-card = { $card }, row { $row }, column { $column }

## Result

result-title = All pairs found!
result-moves =
    { $moves ->
        [one] in 1 move
       *[other] in { $moves } moves
    }
result-time =
    { $minutes ->
        [0] { $seconds } seconds
       *[other] { $minutes } min { $seconds } s
    }
result-time-label = Time
result-moves-label = Moves
result-pairs-label = Pairs
result-hints-label = Hints
result-line = Here they are in the order you found them.
result-continue = Continue
result-speech-few =
    .a = Wow, that was quick! Great game.
    .b = So few moves! That was brilliant.
result-speech-some =
    .a = Nicely played! That was a good game.
    .b = What a lovely game. You played well!
result-speech-many =
    .a = You kept on to the very last one. That was fun!
    .b = That was fun! I liked playing with you.

## Questions

form-title = A few questions
form-calm = Take your time. There are no wrong answers.
form-progress = Page { $number } of { $all }
form-next = Next
# Beside the way on, as long as answers are missing.
form-to-go =
    { $number ->
        [one] One answer to go
       *[other] { $number } answers to go
    }
form-skip = Go on without it
form-not-applicable = Does not apply
form-missing = Please answer this one first.
form-skipped = You left this one out. You may leave it.
form-wrong-number = Please type a whole number from { $lowest } to { $highest }.
form-refused = This holds a line break or another character that cannot be stored. Please type it again.
form-range = from { $lowest } to { $highest }
form-none = Nothing is chosen yet
form-touch = Touch the line.
form-type = Tap here to type
form-number = Tap to enter
form-less = One less
form-more = One more
# Beside the helper's back, while visitors rate it.
form-turned = I am not looking.

## The keyboard on the screen

keyboard-shift = Capitals
keyboard-delete = Delete
keyboard-space = Space
keyboard-done = Done
keyboard-letters = Letters
keyboard-accents = Letters with accents
keyboard-signs = Signs

## Debrief

debrief-take-home = To take home
debrief-code = Photograph this code
debrief-scan-letter = A message to send us
debrief-scan-summary = Your code and our study
debrief-scan = Your code, to scan
debrief-withdraw-by-mail = To have your data deleted, send this code to { $contact }
debrief-withdraw-here = To have your data deleted, tell this code to the people at this table.
debrief-return = With this code you can come back another day.
debrief-questions = Questions about the study: { $contact }
debrief-subject = Please delete my data: { $code }
debrief-continue = Continue

## Thanks

thanks-title = Thank you!
thanks-continue = Finish
thanks-speech =
    .a = It was fun to play with you. Goodbye!
    .b = That was a pleasure. Have a lovely day!

## Everywhere

scroll-more = There is more below
still-there-title = Are you still there?
still-there-line = If not, I will get ready for the next player.
still-there-yes = I am still here
# below the number of seconds that are left: the first where it is 1
still-there-second = second
still-there-seconds = seconds
pause-title = A short break
pause-line = The people at this table need a moment.
pause-kept = Nothing is lost. It goes on by itself.
# time: when the people at the table are back, such as 14:05
pause-back = Back at { $time }.
pause-then = You can play then.
pause-help = Please ask the people at this table for help.
wait-title = One moment, please
wait-line = It goes on by itself.
replay-line = How far it has been played
replay-differs = differs from the record

## The corner: what a visitor may do on every screen

control-stop = Stop
control-language = Language
control-text-size = Text size
control-sound-on = Turn the sound on
control-sound-off = Turn the sound off
control-say-again = Say it again
control-back = Back
stop-title = Do you want to stop?
stop-line-nothing = Nothing about you is stored.
stop-line-kept = If you stop, what was recorded is kept. With your code you can have it deleted.
stop-line-deleted = What was recorded so far is deleted.
stop-code = Photograph your code
stop-yes = Stop now
stop-no = Go on
