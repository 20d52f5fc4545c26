### What the experimenter reads: the card, the notes at the edge, and the panel. None of it is spoken.

## The card and the notes at the edge

console-pin = PIN
console-pin-line = Enter goes on, Esc goes back
console-cancel = Cancel
console-key-delete = Delete
console-key-enter = Enter
console-wait = That was wrong. Wait { $seconds } s.
console-reason = Why?
console-reason-line = A digit chooses, Esc goes back
console-words-line = In your own words, then Enter
console-reason-technical = technical problem
console-reason-wished = the visitor wishes it
console-reason-disturbed = disturbed
console-reason-test = test run
console-reason-other = something else
console-not-now = Not now
console-not-written = It could not be written down, so nothing was changed
console-busy = One moment: another program holds the database
console-done = Done
console-next-avatar = Next: avatar
console-next-robot = Next: robot
console-mute-on = Silent
console-mute-off = Heard again
console-cannot-resume = It cannot go on: { $why }

## The panel

console-title = For the experimenter
console-close = Close
console-keys = Tab and arrows go around, Enter does it, Esc closes. The panel closes by itself after a minute without a touch or a key.
console-all-well = All is well
console-paused = Paused
console-on-break = On a break
console-back =
    { $stage ->
        [attract] Back to the start screen
        [introduction] Back to the introduction
        [practice] Back to the practice
        [game] Back to the game
        [result] Back to the result
        [questions] Back to the questions
        [over] Back to the screen
   *[other] Back to the session
    }

## The first page

console-today = Today
console-sessions-page = Sessions
console-next-page = Settings
console-today-visitors = Visitors today
console-today-early = { $early } ended early
console-today-completed = Completed today
console-today-hour = { $done } in the last hour
console-today-target = Games of the target
console-today-forecast = about { $hours } h more at today’s pace
console-today-no-pace = too few today to tell how long it takes
console-today-stage = Now
console-today-minutes =
    { $minutes ->
        [0] for less than 1 min
       *[other] for { $minutes } min
    }
console-today-begun =
    { $minutes ->
        [0] just begun
       *[other] begun { $minutes } min ago
    }
console-shortcuts = Shortcuts
console-shortcuts-held = Shortcuts: { $keys } and …
console-shortcut-panel = this panel
console-shortcut-pause = pause, go on
console-shortcut-abort = end the session
console-shortcut-next = next visitor
console-shortcut-repeat = say it again
console-shortcut-mute = sound off, on
console-shortcut-volume = volume
console-shortcut-condition = next condition
console-shortcut-embodiment = robot or avatar
console-shortcut-quit = leave the kiosk
console-names-show = Show the conditions’ names
console-names-hide = Hide the conditions’ names
console-test-the-voice = Test the voice
console-test-sentence = Good morning. If you hear this sentence, the voice works.
console-supervisor = Supervisor
console-supervisor-there = running
console-supervisor-none = not running
console-supervisor-remedy = Start the kiosk with one
console-supervisor-how = How to start one
console-remote = From afar
console-remote-there = the status is published
console-remote-not = no connection: { $why }
console-remote-remedy = Check the network and the broker
console-booth = The booth

## Health

console-health = Checks
console-mark-well = in order
console-mark-idle = not in use
console-mark-ill = not well
console-robot = Robot
console-robot-none = There is none
console-robot-absent = none set up
console-robot-remedy = Check its power and the network; the avatar helps meanwhile
console-avatar = Avatar
console-voice = Voice
console-voice-remedy = Check the loudspeaker and the sound settings
console-voice-quiet = silent on purpose
console-voice-quiet-remedy = Visitors can only read what the helper says
console-voice-changed = another voice pack than in earlier sessions
console-voice-changed-remedy = See in which sessions
console-voice-changed-how = How to list them
console-disk = Disk
console-disk-free = { $free } free
console-disk-warn = only { $free } free
console-disk-warn-remedy = Make room this evening
console-disk-refuse = only { $free } free: no session can begin
console-disk-refuse-remedy = Make room now
console-disk-unknown = how much is free cannot be seen
console-disk-unknown-remedy = Check that the data folder can be read
console-database = Database
console-database-remedy = Check the disk and its permissions
console-backup-none = no copy yet
console-backup-none-remedy = A copy protects the data
console-backup-made = last copy { $ago }
console-backup-failed = the last copy failed: { $why }
console-backup-failed-remedy = Mend that, then try again
console-backup-busy = being made …
console-backup-waits = after this session
console-minutes =
    { $minutes ->
        [0] just now
       *[other] { $minutes } min ago
    }
console-hours = { $hours } h ago
console-days =
    { $days ->
        [one] 1 day ago
       *[other] { $days } days ago
    }
console-clock = Clock
console-clock-well = keeps time
console-clock-behind = { $hours } h behind what was written last
console-clock-behind-remedy = Set the clock
console-clock-jumped = was set by { $seconds } s since the start
console-clock-jumped-remedy = Check that the time is right
console-policy = Policy
console-study = Study
console-pin-line-name = PIN
console-pin-set = is asked for
console-pin-none = not set
console-pin-remedy = Set one before you open
console-pin-how = How to set a PIN
console-screen = Screen

## Counts

console-counts = Completed games in all
console-counts-unlisted = Sessions begun in all
console-counts-done = of quota
console-counts-begun = begun
console-counts-dropped = ended early
console-counts-overridden = by hand
console-counts-beyond = past the list
console-counts-withdrawn = withdrawn
console-visits = Not stored: { $declined } declined, { $under_age } under age, { $left } left before deciding
console-automatic = automatic
console-hidden = hidden
console-condition-tom = ToM
console-condition-notom = no ToM
console-condition-mentalised-unexplained = ToM, no reasons
console-condition-random-explained = random, reasons
console-condition-declared = { $name }
console-condition-no-assistance = no help

## Sessions

console-sessions = Last sessions
console-sessions-none = None yet
console-sessions-number = no.
console-sessions-begun = begun
console-sessions-condition = condition
console-sessions-stage = stage
console-sessions-status = status
console-robot-lost = robot lost
console-status-running = under way
console-status-completed = completed
console-status-abandoned = abandoned
console-status-stopped = stopped
console-status-withdrawn = stopped by the visitor
console-status-interrupted = interrupted
console-stage-attract = no visitor
console-stage-about = about the study
console-stage-consent = consent
console-stage-age = age
console-stage-about-you = about the visitor
console-stage-introduction = introduction
console-stage-practice = practice
console-stage-game = game
console-stage-result = result
console-stage-questions = questions
console-stage-debrief = explanation
console-stage-thanks = thanks
console-stage-over = calm screen

## Deviations

console-deviations = Today’s deviations
console-deviations-more = and { $number } more
console-deviations-none = None today
console-note-condition-chosen = next condition: { $what }
console-note-embodiment-chosen = next body: { $what }
console-note-language-chosen = language at rest: { $what }
console-note-volume-changed = volume { $what }
console-note-mute-changed = voice and sounds: { $what }
console-note-session-aborted = session stopped in: { $what }
console-note-session-resumed = session { $what } gone on with
console-note-pin-refused = wrong PIN, number { $what } in a row
console-note-application-quit = kiosk left in: { $what }
console-note-backup-failed = no copy made: { $what }
console-note-withdrawn-again = an older copy held people who withdrew: { $what } deleted again
console-note-withdrawn-list-missing = { $what } is missing: the database may hold people who withdrew
console-note-voice-changed = voice: { $what }
console-note-disk-space-changed = disk: { $what }
console-room-enough = room again
console-room-warn = little room left
console-room-refuse = no room left; no session can begin

## What can be done

console-next-session = From the next session on
console-condition = Condition of the next session
console-embodiment = Who helps
console-language = Language at rest
console-volume-is = Volume { $percent } %
console-volume = Volume
console-actions = Actions
console-repeat = Say it again
console-mute = Mute
console-heard = Turn the sound on
console-stay-paused = Close, stay paused
console-break = A break of
console-to-do = To do
console-sound = Sound
console-data = Data
console-break-row = Back in
console-pause-row = Go on by itself in
console-break-open = untimed
console-break-minutes = { $minutes } min
console-break-end = End the break
console-session = Session
console-abort = End the session
console-next = Next visitor
console-resume = Go on with a session that was cut off
console-resume-one = { $participant } · { $when } · { $stage }
console-backup = Make a copy
console-quit = Leave the kiosk

## Alarms

console-alarms = Alarms
console-alarm-until = {" "}(over at { $time })
console-alarm-robot-lost = The robot is lost; the avatar helps
console-alarm-voice-lost = No sentence is heard: look at the loudspeaker and the sound settings
console-alarm-disk-low = The disk has not enough room for another hour
console-alarm-early-exits = Three sessions in a row have ended early
console-alarm-restarted = The kiosk was started again after it had failed
console-alarm-clock-changed = The clock was changed
console-alarm-backup-old = The last copy is older than a day
console-alarm-no-visitor = No visitor for a long time

## The window of recollect study preview

preview-answer = Answer the questions

## The film of a replay

film-left-out = The visitor answers questions. This is left out.
film-hint = Hint.
film-hint-row = Hint: row { $row }.
film-hint-column = Hint: column { $column }.
film-hint-card = Hint: row { $row }, column { $column }.
film-counts = Turned up before: the target { $seen } ×, its partner { $other } ×.
film-gate-opening = No hint: the first flips of a game are the player's own.
film-gate-doing-well = No hint: the last move was a pair.
film-gate-still-exploring = No hint: no pair was found yet, and it is early.
film-no-hint = No hint: the policy prefers none here.
film-look = Look without words.
film-look-row = Look without words: row { $row }.
film-look-column = Look without words: column { $column }.
film-look-card = Look without words: row { $row }, column { $column }.
film-praise = Comment: the last move was a pair.
film-encouragement = Comment: the last move was not a pair.
film-remark = Remark: it points to no card.
film-memory = % remembered, by the model
