### The names of the cards. German makes one word of the name and "Karte" ("Igel-Karte"), so that no sentence needs an
### article or a case of the picture's name, and the names need no other forms.

card-bear = Bär
card-butterfly = Schmetterling
card-cat = Katze
card-duck = Ente
card-elephant = Elefant
card-fish = Fisch
card-frog = Frosch
card-hedgehog = Igel
card-ladybird = Marienkäfer
card-owl = Eule
card-rabbit = Hase
card-turtle = Schildkröte

card-apple = Apfel
card-banana = Banane
card-cherry = Kirsche
card-grapes = Trauben
card-pear = Birne
card-strawberry = Erdbeere
