### Every sentence on the screens and every one that is spoken outside a hint.

## Attract

attract-title = Do you remember?
attract-line = Play a game of pairs with me. It takes about five minutes.
attract-start = Start

## Introduction

introduction-title = Hello!
introduction-speech =
    .a = Hello, nice to meet you! There are twenty-four cards, and every picture is there twice. Turn two cards at a time and find all the pairs. Now and then I will help you. Good luck!
    .b = Hello, I am glad you are here! Twenty-four cards, twelve pairs. Turn two cards at a time until all the pairs are found. Sometimes I will give you a hint. Have fun!
introduction-turn = Turn two cards at a time.
introduction-match = Two alike stay open. Two different ones turn back.
introduction-help = Now and then I give you a hint. Whether you take it is up to you.
introduction-continue = I am ready

## Game

game-pairs = { $found } of { $all } pairs
game-moves =
    { $moves ->
        [one] 1 move
       *[other] { $moves } moves
    }
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
result-continue = Three short questions
result-speech-few =
    .a = Wow, what a memory! Only { $moves } moves.
    .b = { $moves } moves! That was really quick.
result-speech-some =
    .a = Well done! You needed { $moves } moves.
    .b = Nicely played, { $moves } moves.
result-speech-many =
    .a = You did it, all the pairs are found! Thank you for playing with me.
    .b = There they are, all twelve pairs. That was fun!

## Questions

questions-progress = Question { $number } of { $all }
questions-lowest = not at all
questions-highest = very much
questions-next = Next
questions-skip = Skip
questions-finish = Finish
question-closing-enjoyed = Did you enjoy the game?
question-closing-helped = Did the hints help you to find the pairs?
question-closing-understood = Did your helper seem to know what you remembered?

## Everywhere

still-there-title = Are you still there?
still-there-line = If not, I will get ready for the next player.
still-there-yes = I am still here
pause-title = A short break
pause-line = Please ask the people at this table for help.
