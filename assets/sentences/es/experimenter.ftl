### What the experimenter reads: the card, the notes at the edge, and the panel. None of it is spoken.

## The card and the notes at the edge

desk-pin = PIN
desk-pin-line = Intro para seguir, Esc para volver
desk-wait = No era correcto. Espere { $seconds } s.
desk-reason = ¿Por qué?
desk-reason-line = Una cifra elige, Esc para volver
desk-words-line = Con sus palabras, luego Intro
desk-reason-technical = problema técnico
desk-reason-wished = lo desea quien juega
desk-reason-disturbed = interrupción
desk-reason-test = prueba
desk-reason-other = otra cosa
desk-not-now = Ahora no
desk-not-written = No se pudo anotar: nada ha cambiado
desk-busy = Un momento: otro programa ocupa la base de datos
desk-done = Hecho
desk-next-avatar = Después: avatar
desk-next-robot = Después: robot
desk-quiet-on = En silencio
desk-quiet-off = De nuevo con sonido
desk-cannot-resume = No puede continuar: { $why }

## The panel

desk-title = Panel de control
desk-close = Cerrar
desk-keys = Tab y flechas para moverse, Intro para hacer, Esc para cerrar. Tras un minuto sin nadie se cierra solo.
desk-all-well = Todo está bien
desk-sitting-none = No hay nadie
desk-sitting-paused = Hay una sesión en curso; espera

## Health

desk-health = Estado
desk-robot = Robot
desk-robot-none = No hay
desk-avatar = Avatar
desk-voice = Voz
desk-voice-quiet = en silencio a propósito
desk-disk = Disco
desk-disk-free = { $free } libres
desk-disk-warn = solo { $free } libres: haga sitio esta noche
desk-disk-refuse = solo { $free } libres: nadie puede empezar
desk-disk-unknown = no se sabe cuánto queda libre
desk-database = Datos
desk-backup-none = en uso; aún sin copia
desk-backup-made = en uso; última copia { $ago }
desk-backup-failed = la última copia falló: { $why }
desk-backup-busy = en curso …
desk-backup-waits = tras esta sesión
desk-minutes =
    { $minutes ->
        [0] ahora mismo
       *[other] hace { $minutes } min
    }
desk-hours = hace { $hours } h
desk-days =
    { $days ->
        [one] hace 1 día
       *[other] hace { $days } días
    }
desk-clock = Reloj
desk-clock-well = va como debe
desk-clock-behind = { $hours } h por detrás de lo último escrito: ajústelo
desk-clock-jumped = se ha movido { $seconds } s desde el inicio
desk-policy = Política
desk-study = Estudio
desk-pin-line-name = PIN
desk-pin-set = se pide
desk-pin-none = no hay: cada sesión es una prueba, y quien conozca las teclas puede hacerlo todo
desk-screen = Pantalla

## Counts

desk-counts = Partidas completadas
desk-counts-done = de cuota
desk-counts-dropped = dejadas
desk-counts-overridden = elegidas
desk-counts-beyond = de más
desk-counts-withdrawn = retiradas
desk-visits = Jugaron sin quedar registrados: { $declined } sin consentimiento, { $under_age } menores, { $left } se fueron antes de decidir
desk-automatic = automática
desk-hidden = oculta
desk-condition-tom = ToM
desk-condition-notom = sin ToM
desk-condition-mentalised-unexplained = ToM, sin motivos
desk-condition-random-explained = al azar, con motivos
desk-condition-no-assistance = sin ayuda

## Sittings

desk-sittings = Últimas sesiones
desk-sittings-none = Aún ninguna
desk-robot-lost = robot perdido
desk-status-running = en curso
desk-status-completed = completada
desk-status-abandoned = abandonada
desk-status-stopped = detenida
desk-status-interrupted = interrumpida
desk-stage-attract = nadie
desk-stage-about = sobre el estudio
desk-stage-consent = consentimiento
desk-stage-age = edad
desk-stage-about-you = sobre la persona
desk-stage-introduction = introducción
desk-stage-practice = práctica
desk-stage-game = partida
desk-stage-result = resultado
desk-stage-questions = preguntas
desk-stage-debrief = explicación
desk-stage-thanks = despedida
desk-stage-over = pantalla de espera

## Deviations

desk-deviations = Desviaciones de hoy
desk-deviations-more = y { $number } más
desk-deviations-none = Hoy ninguna
desk-note-condition-chosen = próxima condición: { $what }
desk-note-body-chosen = próximo cuerpo: { $what }
desk-note-language-chosen = idioma en reposo: { $what }
desk-note-volume-changed = volumen { $what }
desk-note-sound-changed = voz y sonidos: { $what }
desk-note-sitting-stopped = sesión detenida en: { $what }
desk-note-sitting-resumed = sesión { $what } reanudada
desk-note-pin-refused = PIN incorrecto, fallo { $what } seguido
desk-note-kiosk-left = quiosco cerrado en: { $what }
desk-note-backup-failed = copia no hecha: { $what }
desk-note-room-changed = disco: { $what }
desk-room-enough = de nuevo hay sitio
desk-room-warn = poco sitio
desk-room-refuse = sin sitio; nadie puede empezar

## What can be done

desk-next-sitting = Desde la próxima sesión
desk-condition = Condición de la próxima sesión
desk-body = Quién ayuda
desk-language = Idioma en reposo
desk-volume = Volumen
desk-now = Ahora
desk-again = Repetir la frase
desk-quiet = Silencio
desk-heard = Activar sonido
desk-stay-paused = Seguir en pausa después
desk-not-stay-paused = Continuar al cerrar
desk-end = Terminar la sesión
desk-next = Siguiente persona
desk-resume = Reanudar una sesión cortada
desk-resume-none = No hay ninguna
desk-resume-one = { $participant } · { $when } · { $stage }
desk-backup = Hacer una copia
desk-leave = Salir del quiosco
