encourage =
    .a = You are doing well, go on.
    .b = Take your time, you can do it.
    .c = Every card you see helps you later.
