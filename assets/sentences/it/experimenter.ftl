### What the experimenter reads: the card, the notes at the edge, and the panel. None of it is spoken.

## The card and the notes at the edge

desk-pin = PIN
desk-pin-line = Invio per continuare, Esc per tornare
desk-wait = Non era giusto. Attendere { $seconds } s.
desk-reason = Perché?
desk-reason-line = Una cifra sceglie, Esc per tornare
desk-words-line = Con parole proprie, poi Invio
desk-reason-technical = problema tecnico
desk-reason-wished = lo desidera chi gioca
desk-reason-disturbed = disturbo
desk-reason-test = prova
desk-reason-other = altro
desk-not-now = Non adesso
desk-not-written = Non è stato possibile annotarlo: nulla è cambiato
desk-busy = Un momento: un altro programma occupa la base di dati
desk-done = Fatto
desk-next-avatar = Poi: avatar
desk-next-robot = Poi: robot
desk-quiet-on = Silenzio
desk-quiet-off = Di nuovo udibile
desk-cannot-resume = Non può continuare: { $why }

## The panel

desk-title = Pannello di controllo
desk-close = Chiudi
desk-keys = Tab e frecce per spostarsi, Invio per eseguire, Esc per chiudere. Dopo un minuto senza nessuno si chiude da sé.
desk-all-well = Tutto bene
desk-sitting-none = Non c’è nessuno
desk-sitting-paused = Una seduta è in corso; attende

## Health

desk-health = Stato
desk-robot = Robot
desk-robot-none = Non ce n’è
desk-avatar = Avatar
desk-voice = Voce
desk-voice-quiet = in silenzio di proposito
desk-disk = Disco
desk-disk-free = { $free } liberi
desk-disk-warn = solo { $free } liberi: fare spazio stasera
desk-disk-refuse = solo { $free } liberi: nessuno può iniziare
desk-disk-unknown = non si sa quanto spazio resta
desk-database = Dati
desk-backup-none = in uso; ancora nessuna copia
desk-backup-made = in uso; ultima copia { $ago }
desk-backup-failed = l’ultima copia non è riuscita: { $why }
desk-backup-busy = in corso …
desk-backup-waits = dopo questa seduta
desk-minutes =
    { $minutes ->
        [0] adesso
       *[other] { $minutes } min fa
    }
desk-hours = { $hours } h fa
desk-days =
    { $days ->
        [one] 1 giorno fa
       *[other] { $days } giorni fa
    }
desk-clock = Orologio
desk-clock-well = va come deve
desk-clock-behind = indietro di { $hours } h rispetto all’ultima registrazione: regolarlo
desk-clock-jumped = è stato spostato di { $seconds } s dall’avvio
desk-policy = Politica
desk-study = Studio
desk-pin-line-name = PIN
desk-pin-set = viene chiesto
desk-pin-none = non c’è: ogni sessione è una prova, e chi conosce i tasti può fare tutto
desk-screen = Schermo

## Counts

desk-counts = Partite completate
desk-counts-done = su quota
desk-counts-dropped = lasciate
desk-counts-overridden = scelte
desk-counts-beyond = oltre
desk-counts-withdrawn = ritirate
desk-visits = Hanno giocato senza essere registrati: { $declined } senza consenso, { $under_age } minorenni, { $left } andati via prima di decidere
desk-automatic = automatica
desk-hidden = nascosta
desk-condition-tom = ToM
desk-condition-notom = senza ToM
desk-condition-mentalised-unexplained = ToM, senza motivi
desk-condition-random-explained = casuale, con motivi
desk-condition-no-assistance = nessun aiuto

## Sittings

desk-sittings = Ultime sedute
desk-sittings-none = Ancora nessuna
desk-robot-lost = robot perso
desk-status-running = in corso
desk-status-completed = completata
desk-status-abandoned = abbandonata
desk-status-stopped = fermata
desk-status-interrupted = interrotta
desk-stage-attract = nessuno
desk-stage-about = sullo studio
desk-stage-consent = consenso
desk-stage-age = età
desk-stage-about-you = sulla persona
desk-stage-introduction = introduzione
desk-stage-practice = prova
desk-stage-game = partita
desk-stage-result = risultato
desk-stage-questions = domande
desk-stage-debrief = spiegazione
desk-stage-thanks = saluti
desk-stage-over = schermata di attesa

## Deviations

desk-deviations = Deviazioni di oggi
desk-deviations-more = e altre { $number }
desk-deviations-none = Oggi nessuna
desk-note-condition-chosen = prossima condizione: { $what }
desk-note-body-chosen = prossimo corpo: { $what }
desk-note-language-chosen = lingua a riposo: { $what }
desk-note-volume-changed = volume { $what }
desk-note-sound-changed = voce e suoni: { $what }
desk-note-sitting-stopped = seduta fermata in: { $what }
desk-note-sitting-resumed = seduta { $what } ripresa
desk-note-pin-refused = PIN errato, errore { $what } di seguito
desk-note-kiosk-left = chiosco lasciato in: { $what }
desk-note-backup-failed = copia non fatta: { $what }
desk-note-room-changed = disco: { $what }
desk-room-enough = di nuovo spazio
desk-room-warn = poco spazio
desk-room-refuse = spazio finito; nessuno può iniziare

## What can be done

desk-next-sitting = Dalla prossima seduta
desk-condition = Condizione della prossima seduta
desk-body = Chi aiuta
desk-language = Lingua a riposo
desk-volume = Volume
desk-now = Adesso
desk-again = Ripeti la frase
desk-quiet = Silenzio
desk-heard = Riattiva l’audio
desk-stay-paused = Resta in pausa dopo
desk-not-stay-paused = Continua alla chiusura
desk-end = Termina la seduta
desk-next = Prossima persona
desk-resume = Riprendi una seduta interrotta
desk-resume-none = Non ce n’è
desk-resume-one = { $participant } · { $when } · { $stage }
desk-backup = Fai una copia
desk-leave = Esci dal chiosco
