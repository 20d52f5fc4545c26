### What the experimenter reads: the card, the notes at the edge, and the panel. None of it is spoken.

## The card and the notes at the edge

desk-pin = PIN
desk-pin-line = Enter goes on, Esc goes back
desk-wait = That was wrong. Wait { $seconds } s.
desk-reason = Why?
desk-reason-line = A digit chooses, Esc goes back
desk-words-line = In your own words, then Enter
desk-reason-technical = technical problem
desk-reason-wished = the visitor wishes it
desk-reason-disturbed = disturbed
desk-reason-test = test run
desk-reason-other = something else
desk-not-now = Not now
desk-not-written = It could not be written down, so nothing was changed
desk-busy = One moment: another program holds the database
desk-done = Done
desk-next-avatar = Next: avatar
desk-next-robot = Next: robot
desk-quiet-on = Silent
desk-quiet-off = Heard again
desk-cannot-resume = It cannot go on: { $why }

## The panel

desk-title = For the experimenter
desk-close = Close
desk-keys = Tab and arrows go around, Enter does it, Esc closes. Nobody at it for a minute: it closes by itself.
desk-all-well = All is well
desk-sitting-none = Nobody is there
desk-sitting-paused = A sitting is under way; it waits

## Health

desk-health = How everything is
desk-robot = Robot
desk-robot-none = There is none
desk-avatar = Avatar
desk-voice = Voice
desk-voice-quiet = silent on purpose
desk-disk = Disk
desk-disk-free = { $free } free
desk-disk-warn = only { $free } free: make room this evening
desk-disk-refuse = only { $free } free: nobody can begin
desk-disk-unknown = nobody can tell how much is free
desk-database = Database
desk-backup-none = written to; no copy yet
desk-backup-made = written to; last copy { $ago }
desk-backup-failed = the last copy failed: { $why }
desk-backup-busy = being made …
desk-backup-waits = after this sitting
desk-minutes =
    { $minutes ->
        [0] just now
       *[other] { $minutes } min ago
    }
desk-hours = { $hours } h ago
desk-days =
    { $days ->
        [one] 1 day ago
       *[other] { $days } days ago
    }
desk-clock = Clock
desk-clock-well = goes as it should
desk-clock-behind = { $hours } h behind what was written last: set it
desk-clock-jumped = was set by { $seconds } s since the start
desk-policy = Policy
desk-study = Study
desk-pin-line-name = PIN
desk-pin-set = is asked for
desk-pin-none = none is set: every sitting is a trial, and anybody who knows the keys can do everything
desk-screen = Screen

## Counts

desk-counts = Completed games
desk-counts-done = of quota
desk-counts-dropped = left early
desk-counts-overridden = chosen
desk-counts-beyond = beyond
desk-counts-withdrawn = withdrawn
desk-visits = Played without being stored: { $declined } declined, { $under_age } under age, { $left } left before deciding
desk-automatic = automatic
desk-hidden = hidden
desk-condition-tom = ToM
desk-condition-notom = no ToM
desk-condition-mentalised-unexplained = ToM, no reasons
desk-condition-random-explained = random, reasons
desk-condition-no-assistance = no help

## Sittings

desk-sittings = Last sittings
desk-sittings-none = None yet
desk-robot-lost = robot lost
desk-status-running = under way
desk-status-completed = completed
desk-status-abandoned = abandoned
desk-status-stopped = stopped
desk-status-interrupted = interrupted
desk-stage-attract = nobody there
desk-stage-about = about the study
desk-stage-consent = consent
desk-stage-age = age
desk-stage-about-you = about the visitor
desk-stage-introduction = introduction
desk-stage-practice = practice
desk-stage-game = game
desk-stage-result = result
desk-stage-questions = questions
desk-stage-debrief = explanation
desk-stage-thanks = thanks
desk-stage-over = calm screen

## Deviations

desk-deviations = Today’s deviations
desk-deviations-more = and { $number } more
desk-deviations-none = None today
desk-note-condition-chosen = next condition: { $what }
desk-note-body-chosen = next body: { $what }
desk-note-language-chosen = language at rest: { $what }
desk-note-volume-changed = volume { $what }
desk-note-sound-changed = voice and sounds: { $what }
desk-note-sitting-stopped = sitting stopped in: { $what }
desk-note-sitting-resumed = sitting { $what } gone on with
desk-note-pin-refused = wrong PIN, number { $what } in a row
desk-note-kiosk-left = kiosk left in: { $what }
desk-note-backup-failed = no copy made: { $what }
desk-note-room-changed = disk: { $what }
desk-room-enough = room again
desk-room-warn = little room left
desk-room-refuse = no room left; nobody can begin

## What can be done

desk-next-sitting = From the next sitting on
desk-condition = Condition of the next sitting
desk-body = Who helps
desk-language = Language at rest
desk-volume = Volume
desk-now = Now
desk-again = Say it again
desk-quiet = Silence
desk-heard = Sound on
desk-stay-paused = Stay paused after closing
desk-not-stay-paused = Go on after closing
desk-end = End the sitting
desk-next = Next visitor
desk-resume = Go on with a sitting that was cut off
desk-resume-none = There is none
desk-resume-one = { $participant } · { $when } · { $stage }
desk-backup = Make a copy
desk-leave = Leave the kiosk
