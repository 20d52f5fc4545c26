### The names of the cards: one message for every picture of every deck, by the name of its file. A new deck needs its
### names here and nothing else. A sentence may use $card; other languages may add forms as attributes (see "it"), and
### a sentence may use those as $card-<form>.

## Animals

card-bear = bear
card-butterfly = butterfly
card-cat = cat
card-duck = duck
card-elephant = elephant
card-fish = fish
card-frog = frog
card-hedgehog = hedgehog
card-ladybird = ladybird
card-owl = owl
card-rabbit = rabbit
card-turtle = turtle

## Fruit

card-apple = apple
card-banana = banana
card-cherry = cherry
card-grapes = grapes
card-pear = pear
card-strawberry = strawberry
