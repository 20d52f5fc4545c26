### What the experimenter reads: the card, the notes at the edge, and the panel. None of it is spoken.

## The card and the notes at the edge

console-pin = PIN
console-pin-line = Intro para seguir, Esc para volver
console-cancel = Cancelar
console-key-delete = Borrar
console-key-enter = Intro
console-wait = No era correcto. Espere { $seconds } s.
console-reason = ¿Por qué?
console-reason-line = Una cifra elige, Esc para volver
console-words-line = Con sus palabras, luego Intro
console-reason-technical = problema técnico
console-reason-wished = lo desea quien juega
console-reason-disturbed = interrupción
console-reason-test = prueba
console-reason-other = otra cosa
console-not-now = Ahora no
console-not-written = No se pudo anotar: nada ha cambiado
console-busy = Un momento: otro programa ocupa la base de datos
console-done = Hecho
console-next-avatar = Después: avatar
console-next-robot = Después: robot
console-mute-on = En silencio
console-mute-off = De nuevo con sonido
console-cannot-resume = No puede continuar: { $why }

## The panel

console-title = Panel de control
console-close = Cerrar
console-keys = Tab y flechas para moverse, Intro para hacer, Esc para cerrar. Tras un minuto sin uso se cierra solo.
console-all-well = Todo está bien
console-paused = En pausa
console-on-break = En descanso
console-back =
    { $stage ->
        [attract] Volver al inicio
        [introduction] Volver a la introducción
        [practice] Volver a la práctica
        [game] Volver al juego
        [result] Volver al resultado
        [questions] Volver a las preguntas
        [over] Volver a la pantalla
   *[other] Volver a la sesión
    }

## The first page

console-today = Hoy
console-sessions-page = Sesiones
console-next-page = Ajustes
console-today-visitors = Visitantes hoy
console-today-early = { $early } a medias
console-today-completed = Completadas hoy
console-today-hour = { $done } en la última hora
console-today-target = Partidas previstas
console-today-forecast = unas { $hours } h más al ritmo de hoy
console-today-no-pace = hoy aún son pocas para estimarlo
console-today-stage = Ahora
console-today-minutes =
    { $minutes ->
        [0] desde hace menos de 1 min
       *[other] desde hace { $minutes } min
    }
console-today-begun =
    { $minutes ->
        [0] acaba de empezar
       *[other] empezó hace { $minutes } min
    }
console-shortcuts = Atajos
console-shortcuts-held = Atajos: { $keys } y …
console-shortcut-panel = este panel
console-shortcut-pause = pausar, seguir
console-shortcut-abort = terminar la sesión
console-shortcut-next = próxima persona
console-shortcut-repeat = repetir la frase
console-shortcut-mute = sonido sí o no
console-shortcut-volume = volumen
console-shortcut-condition = próxima condición
console-shortcut-embodiment = robot o avatar
console-shortcut-quit = salir
console-names-show = Mostrar las condiciones
console-names-hide = Ocultar las condiciones
console-test-the-voice = Probar la voz
console-test-sentence = Buenos días. Si oyes esta frase, la voz funciona.
console-supervisor = Supervisor
console-supervisor-there = activo
console-supervisor-none = no hay
console-supervisor-remedy = Inicia el quiosco con uno
console-supervisor-how = Cómo iniciarlo
console-remote = A distancia
console-remote-there = el estado se publica
console-remote-not = sin conexión: { $why }
console-remote-remedy = Revisa la red y el servidor
console-booth = El puesto

## Health

console-health = Comprobaciones
console-mark-well = en orden
console-mark-idle = no se usa
console-mark-ill = no está bien
console-robot = Robot
console-robot-none = No hay
console-robot-absent = sin configurar
console-robot-remedy = Revisa su corriente y la red; mientras, ayuda el avatar
console-avatar = Avatar
console-voice = Voz
console-voice-remedy = Revisa el altavoz y los ajustes de sonido
console-voice-quiet = en silencio a propósito
console-voice-quiet-remedy = Solo se puede leer lo que dice el ayudante
console-voice-changed = otro paquete de voz que en sesiones anteriores
console-voice-changed-remedy = Mira en qué sesiones
console-voice-changed-how = Cómo verlas
console-disk = Disco
console-disk-free = { $free } libres
console-disk-warn = solo { $free } libres
console-disk-warn-remedy = Haz sitio esta noche
console-disk-refuse = solo { $free } libres: nadie puede empezar
console-disk-refuse-remedy = Haz sitio ya
console-disk-unknown = no se sabe cuánto queda libre
console-disk-unknown-remedy = Comprueba que se puede leer la carpeta de datos
console-database = Datos
console-database-remedy = Revisa el disco y sus permisos
console-backup-none = aún no hay copia
console-backup-none-remedy = Una copia protege los datos
console-backup-made = última copia { $ago }
console-backup-failed = la última copia falló: { $why }
console-backup-failed-remedy = Arréglalo y vuelve a intentarlo
console-backup-busy = en curso …
console-backup-waits = tras esta sesión
console-minutes =
    { $minutes ->
        [0] ahora mismo
       *[other] hace { $minutes } min
    }
console-hours = hace { $hours } h
console-days =
    { $days ->
        [one] hace 1 día
       *[other] hace { $days } días
    }
console-clock = Reloj
console-clock-well = va como debe
console-clock-behind = { $hours } h por detrás de lo último escrito
console-clock-behind-remedy = Ajusta el reloj
console-clock-jumped = se ha movido { $seconds } s desde el inicio
console-clock-jumped-remedy = Comprueba la hora
console-policy = Política
console-study = Estudio
console-pin-line-name = PIN
console-pin-set = se pide
console-pin-none = no hay
console-pin-remedy = Crea uno antes de abrir
console-pin-how = Cómo crearlo
console-screen = Pantalla

## Counts

console-counts = Completadas en total
console-counts-unlisted = Sesiones iniciadas en total
console-counts-done = de cuota
console-counts-begun = iniciadas
console-counts-dropped = a medias
console-counts-overridden = a mano
console-counts-beyond = tras el listado
console-counts-withdrawn = retiradas
console-visits = Sin registrar: { $declined } sin consentimiento, { $under_age } menores, { $left } se fueron sin decidir
console-automatic = automática
console-hidden = oculta
console-condition-tom = ToM
console-condition-notom = sin ToM
console-condition-mentalised-unexplained = ToM, sin motivos
console-condition-random-explained = al azar, con motivos
console-condition-declared = { $name }
console-condition-no-assistance = sin ayuda

## Sessions

console-sessions = Últimas sesiones
console-sessions-none = Aún ninguna
console-sessions-number = n.º
console-sessions-begun = inicio
console-sessions-condition = condición
console-sessions-stage = fase
console-sessions-status = estado
console-robot-lost = robot perdido
console-status-running = en curso
console-status-completed = completada
console-status-abandoned = abandonada
console-status-stopped = detenida
console-status-withdrawn = detenida por el visitante
console-status-interrupted = interrumpida
console-stage-attract = nadie
console-stage-about = sobre el estudio
console-stage-consent = consentimiento
console-stage-age = edad
console-stage-about-you = sobre la persona
console-stage-introduction = introducción
console-stage-practice = práctica
console-stage-game = partida
console-stage-result = resultado
console-stage-questions = preguntas
console-stage-debrief = explicación
console-stage-thanks = despedida
console-stage-over = pantalla de espera

## Deviations

console-deviations = Desviaciones de hoy
console-deviations-more = y { $number } más
console-deviations-none = Hoy ninguna
console-note-condition-chosen = próxima condición: { $what }
console-note-embodiment-chosen = próximo cuerpo: { $what }
console-note-language-chosen = idioma en reposo: { $what }
console-note-volume-changed = volumen { $what }
console-note-mute-changed = voz y sonidos: { $what }
console-note-session-aborted = sesión detenida en: { $what }
console-note-session-resumed = sesión { $what } reanudada
console-note-pin-refused = PIN incorrecto, fallo { $what } seguido
console-note-application-quit = quiosco cerrado en: { $what }
console-note-backup-failed = copia no hecha: { $what }
console-note-withdrawn-again = una copia anterior contenía personas que se retiraron: { $what } eliminadas de nuevo
console-note-withdrawn-list-missing = falta { $what }: los datos pueden contener personas que se retiraron
console-note-voice-changed = voz: { $what }
console-note-disk-space-changed = disco: { $what }
console-room-enough = de nuevo hay sitio
console-room-warn = poco sitio
console-room-refuse = sin sitio; nadie puede empezar

## What can be done

console-next-session = Desde la próxima sesión
console-condition = Condición de la próxima sesión
console-embodiment = Quién ayuda
console-language = Idioma en reposo
console-volume-is = Volumen { $percent } %
console-volume = Volumen
console-actions = Acciones
console-repeat = Repetir
console-mute = Silenciar
console-heard = Activar el sonido
console-stay-paused = Cerrar y seguir en pausa
console-break = Una pausa de
console-to-do = Por hacer
console-sound = Sonido
console-data = Datos
console-break-row = Vuelvo en
console-pause-row = Sigue solo en
console-break-open = sin hora
console-break-minutes = { $minutes } min
console-break-end = Terminar la pausa
console-session = Sesión
console-abort = Terminar la sesión
console-next = Siguiente persona
console-resume = Reanudar una sesión cortada
console-resume-one = { $participant } · { $when } · { $stage }
console-backup = Hacer una copia
console-quit = Salir del quiosco

## Alarmas

console-alarms = Alarmas
console-alarm-until = {" "}(terminó a las { $time })
console-alarm-robot-lost = El robot no responde; ayuda el avatar
console-alarm-voice-lost = Las frases no se oyen: revise el altavoz y los ajustes de sonido
console-alarm-disk-low = En el disco no hay sitio para otra hora
console-alarm-early-exits = Tres sesiones seguidas han quedado a medias
console-alarm-restarted = El programa arrancó de nuevo después de un fallo
console-alarm-clock-changed = Se ha cambiado el reloj
console-alarm-backup-old = La última copia tiene más de un día
console-alarm-no-visitor = Ningún visitante desde hace mucho tiempo

## La ventana de recollect study preview

preview-answer = Responder a las preguntas

## La película de una repetición

film-left-out = El visitante responde a preguntas. Esta parte se omite.
film-hint = Ayuda.
film-hint-row = Ayuda: fila { $row }.
film-hint-column = Ayuda: columna { $column }.
film-hint-card = Ayuda: fila { $row }, columna { $column }.
film-counts = Vueltas antes: la carta señalada { $seen } ×, su pareja { $other } ×.
film-gate-opening = Sin ayuda: las primeras cartas de una partida son del jugador.
film-gate-doing-well = Sin ayuda: la última jugada fue una pareja.
film-gate-still-exploring = Sin ayuda: es pronto y aún no hay ninguna pareja.
film-no-hint = Sin ayuda: aquí la política prefiere ninguna.
film-look = Mirada sin palabras.
film-look-row = Mirada sin palabras: fila { $row }.
film-look-column = Mirada sin palabras: columna { $column }.
film-look-card = Mirada sin palabras: fila { $row }, columna { $column }.
film-praise = Comentario: la última jugada fue una pareja.
film-encouragement = Comentario: la última jugada no fue una pareja.
film-remark = Observación: no señala ninguna carta.
film-memory = % recordadas, según el modelo
