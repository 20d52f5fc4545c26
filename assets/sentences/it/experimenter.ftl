### What the experimenter reads: the card, the notes at the edge, and the panel. None of it is spoken.

## The card and the notes at the edge

console-pin = PIN
console-pin-line = Invio per continuare, Esc per tornare
console-cancel = Annulla
console-key-delete = Cancella
console-key-enter = Invio
console-wait = Non era giusto. Attendere { $seconds } s.
console-reason = Perché?
console-reason-line = Una cifra sceglie, Esc per tornare
console-words-line = Con parole proprie, poi Invio
console-reason-technical = problema tecnico
console-reason-wished = lo desidera chi gioca
console-reason-disturbed = disturbo
console-reason-test = prova
console-reason-other = altro
console-not-now = Non adesso
console-not-written = Non è stato possibile annotarlo: nulla è cambiato
console-busy = Un momento: un altro programma occupa la base di dati
console-done = Fatto
console-next-avatar = Poi: avatar
console-next-robot = Poi: robot
console-mute-on = Silenzio
console-mute-off = Di nuovo udibile
console-cannot-resume = Non può continuare: { $why }

## The panel

console-title = Pannello di controllo
console-close = Chiudi
console-keys = Tab e frecce per spostarsi, Invio per eseguire, Esc per chiudere. Dopo un minuto senza uso si chiude da sé.
console-all-well = Tutto bene
console-paused = In pausa
console-on-break = In pausa
console-back =
    { $stage ->
        [attract] Torna all’inizio
        [introduction] Torna all’introduzione
        [practice] Torna alla prova
        [game] Torna al gioco
        [result] Torna al risultato
        [questions] Torna alle domande
        [over] Torna allo schermo
   *[other] Torna alla seduta
    }

## The first page

console-today = Oggi
console-sessions-page = Sedute
console-next-page = Impostazioni
console-today-visitors = Visitatori oggi
console-today-early = { $early } finite prima
console-today-completed = Completate oggi
console-today-hour = { $done } nell’ultima ora
console-today-target = Partite previste
console-today-forecast = ancora circa { $hours } h al ritmo di oggi
console-today-no-pace = oggi ancora troppo poche per una stima
console-today-stage = Adesso
console-today-minutes =
    { $minutes ->
        [0] da meno di 1 min
       *[other] da { $minutes } min
    }
console-today-begun =
    { $minutes ->
        [0] da meno di 1 min
       *[other] da { $minutes } min
    }
console-shortcuts = Tasti rapidi
console-shortcuts-held = Tasti rapidi: { $keys } e …
console-shortcut-panel = questo pannello
console-shortcut-pause = pausa, riprendi
console-shortcut-abort = termina la seduta
console-shortcut-next = prossima persona
console-shortcut-repeat = ripeti la frase
console-shortcut-mute = audio sì o no
console-shortcut-volume = volume
console-shortcut-condition = prossima condizione
console-shortcut-embodiment = robot o avatar
console-shortcut-quit = esci
console-names-show = Mostra le condizioni
console-names-hide = Nascondi le condizioni
console-test-the-voice = Prova la voce
console-test-sentence = Buongiorno. Se senti questa frase, la voce funziona.
console-supervisor = Supervisore
console-supervisor-there = attivo
console-supervisor-none = non c’è
console-supervisor-remedy = Avvia il chiosco con uno
console-supervisor-how = Come avviarlo
console-remote = A distanza
console-remote-there = lo stato viene pubblicato
console-remote-not = nessuna connessione: { $why }
console-remote-remedy = Controlla la rete e il server
console-booth = La postazione

## Health

console-health = Controlli
console-mark-well = in ordine
console-mark-idle = non in uso
console-mark-ill = non va bene
console-robot = Robot
console-robot-none = Non ce n’è
console-robot-absent = assente
console-robot-remedy = Controlla la corrente e la rete; intanto aiuta l’avatar
console-avatar = Avatar
console-voice = Voce
console-voice-remedy = Controlla l’altoparlante e le impostazioni dell’audio
console-voice-quiet = in silenzio di proposito
console-voice-quiet-remedy = Si può solo leggere ciò che dice l’aiutante
console-voice-changed = pacchetto vocale diverso da quello delle sessioni precedenti
console-voice-changed-remedy = Vedi in quali sedute
console-voice-changed-how = Come vederle
console-disk = Disco
console-disk-free = { $free } liberi
console-disk-warn = solo { $free } liberi
console-disk-warn-remedy = Fai spazio stasera
console-disk-refuse = solo { $free } liberi: nessuno può iniziare
console-disk-refuse-remedy = Fai spazio subito
console-disk-unknown = non si sa quanto spazio resta
console-disk-unknown-remedy = Controlla che la cartella dei dati sia leggibile
console-database = Dati
console-database-remedy = Controlla il disco e i suoi permessi
console-backup-none = nessuna copia
console-backup-none-remedy = Una copia protegge i dati
console-backup-made = ultima copia { $ago }
console-backup-failed = l’ultima copia non è riuscita: { $why }
console-backup-failed-remedy = Risolvi, poi riprova
console-backup-busy = in corso …
console-backup-waits = dopo questa seduta
console-minutes =
    { $minutes ->
        [0] adesso
       *[other] { $minutes } min fa
    }
console-hours = { $hours } h fa
console-days =
    { $days ->
        [one] 1 giorno fa
       *[other] { $days } giorni fa
    }
console-clock = Orologio
console-clock-well = va come deve
console-clock-behind = indietro di { $hours } h rispetto all’ultima registrazione
console-clock-behind-remedy = Regola l’orologio
console-clock-jumped = è stato spostato di { $seconds } s dall’avvio
console-clock-jumped-remedy = Controlla l’ora
console-policy = Politica
console-study = Studio
console-pin-line-name = PIN
console-pin-set = viene chiesto
console-pin-none = non c’è
console-pin-remedy = Impostane uno prima di aprire
console-pin-how = Come impostarlo
console-screen = Schermo

## Counts

console-counts = Partite completate in tutto
console-counts-unlisted = Sessioni iniziate in tutto
console-counts-done = su quota
console-counts-begun = iniziate
console-counts-dropped = finite prima
console-counts-overridden = a mano
console-counts-beyond = oltre la lista
console-counts-withdrawn = ritirate
console-visits = Non registrati: { $declined } senza consenso, { $under_age } minorenni, { $left } andati via prima di decidere
console-automatic = automatica
console-hidden = nascosta
console-condition-tom = ToM
console-condition-notom = senza ToM
console-condition-mentalised-unexplained = ToM, senza motivi
console-condition-random-explained = casuale, con motivi
console-condition-declared = { $name }
console-condition-no-assistance = nessun aiuto

## Sessions

console-sessions = Ultime sedute
console-sessions-none = Ancora nessuna
console-sessions-number = n.
console-sessions-begun = inizio
console-sessions-condition = condizione
console-sessions-stage = fase
console-sessions-status = esito
console-robot-lost = robot perso
console-status-running = in corso
console-status-completed = completata
console-status-abandoned = abbandonata
console-status-stopped = fermata
console-status-withdrawn = interrotta dal visitatore
console-status-interrupted = interrotta
console-stage-attract = nessuno
console-stage-about = sullo studio
console-stage-consent = consenso
console-stage-age = età
console-stage-about-you = sulla persona
console-stage-introduction = introduzione
console-stage-practice = prova
console-stage-game = partita
console-stage-result = risultato
console-stage-questions = domande
console-stage-debrief = spiegazione
console-stage-thanks = saluti
console-stage-over = schermata di attesa

## Deviations

console-deviations = Deviazioni di oggi
console-deviations-more = e altre { $number }
console-deviations-none = Oggi nessuna
console-note-condition-chosen = prossima condizione: { $what }
console-note-embodiment-chosen = prossimo corpo: { $what }
console-note-language-chosen = lingua a riposo: { $what }
console-note-volume-changed = volume { $what }
console-note-mute-changed = voce e suoni: { $what }
console-note-session-aborted = seduta fermata in: { $what }
console-note-session-resumed = seduta { $what } ripresa
console-note-pin-refused = PIN errato, errore { $what } di seguito
console-note-application-quit = chiosco lasciato in: { $what }
console-note-backup-failed = copia non fatta: { $what }
console-note-withdrawn-again = una copia precedente conteneva persone che si erano ritirate: { $what } eliminate di nuovo
console-note-withdrawn-list-missing = manca { $what }: i dati possono contenere persone che si sono ritirate
console-note-voice-changed = voce: { $what }
console-note-disk-space-changed = disco: { $what }
console-room-enough = di nuovo spazio
console-room-warn = poco spazio
console-room-refuse = spazio finito; nessuno può iniziare

## What can be done

console-next-session = Dalla prossima seduta
console-condition = Condizione della prossima seduta
console-embodiment = Chi aiuta
console-language = Lingua a riposo
console-volume-is = Volume { $percent } %
console-volume = Volume
console-actions = Azioni
console-repeat = Ripeti
console-mute = Silenzia
console-heard = Attiva l’audio
console-stay-paused = Chiudi e resta in pausa
console-break = Una pausa di
console-to-do = Da fare
console-sound = Suono
console-data = Dati
console-break-row = Torno tra
console-pause-row = Riprende tra
console-break-open = senza ora
console-break-minutes = { $minutes } min
console-break-end = Termina la pausa
console-session = Seduta
console-abort = Termina la seduta
console-next = Prossima persona
console-resume = Riprendi una seduta interrotta
console-resume-one = { $participant } · { $when } · { $stage }
console-backup = Fai una copia
console-quit = Esci dal chiosco

## Allarmi

console-alarms = Allarmi
console-alarm-until = {" "}(finito alle { $time })
console-alarm-robot-lost = Il robot non risponde più; aiuta l’avatar
console-alarm-voice-lost = Le frasi non si sentono: guardare l’altoparlante e le impostazioni dell’audio
console-alarm-disk-low = Il disco non basta per un’altra ora
console-alarm-early-exits = Tre sedute di fila sono finite prima
console-alarm-restarted = Il programma è ripartito dopo un guasto
console-alarm-clock-changed = L’orologio è stato cambiato
console-alarm-backup-old = L’ultima copia ha più di un giorno
console-alarm-no-visitor = Nessun visitatore da molto tempo

## La finestra di recollect study preview

preview-answer = Rispondi alle domande

## Il film di una riproduzione

film-left-out = Il visitatore risponde a delle domande. Questa parte è omessa.
film-hint = Aiuto.
film-hint-row = Aiuto: riga { $row }.
film-hint-column = Aiuto: colonna { $column }.
film-hint-card = Aiuto: riga { $row }, colonna { $column }.
film-counts = Girate prima: la carta indicata { $seen } ×, la sua compagna { $other } ×.
film-gate-opening = Nessun aiuto: le prime carte di una partita si girano da soli.
film-gate-doing-well = Nessun aiuto: l'ultima mossa era una coppia.
film-gate-still-exploring = Nessun aiuto: è presto, e non c'è ancora una coppia.
film-no-hint = Nessun aiuto: qui la politica non ne dà.
film-look = Sguardo senza parole.
film-look-row = Sguardo senza parole: riga { $row }.
film-look-column = Sguardo senza parole: colonna { $column }.
film-look-card = Sguardo senza parole: riga { $row }, colonna { $column }.
film-praise = Commento: l'ultima mossa era una coppia.
film-encouragement = Commento: l'ultima mossa non era una coppia.
film-remark = Osservazione: non indica nessuna carta.
film-memory = % ricordate, secondo il modello
