encourage =
    .a = Stai andando bene, continua.
    .b = Fai con calma, ce la puoi fare.
    .c = Ogni carta che vedi ti servirà dopo.
