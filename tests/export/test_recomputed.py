"""Every measure of the study, worked out anew from the exported tables by a few plain lines, is the stored one."""

from __future__ import annotations

import json
from collections import defaultdict
from collections.abc import Callable
from statistics import fmean

import pytest

from tests.export.conftest import PARTICIPANTS

Rows = list[dict[str, str]]
Read = Callable[[str], Rows]

LEVELS = {"no_help": 0, "sug_col": 0.5, "sug_row": 1, "sug_card": 2}


def by_participant(rows: Rows) -> defaultdict[str, Rows]:
    found: defaultdict[str, Rows] = defaultdict(list)
    for row in rows:
        found[row["participant_id"]].append(row)
    return found


def text(value: float | None) -> str:
    return "" if value is None else repr(value)


def share(part: float, whole: int) -> float | None:
    return part / whole if whole else None


def within(spans: list[tuple[int, int]], begin: int, end: int) -> int:
    """How many of the milliseconds between two times lie in any of these spans."""
    spans = sorted((max(since, begin), min(until, end)) for since, until in spans)
    total, reached = 0, begin
    for since, until in spans:
        total += max(0, until - max(since, reached))
        reached = max(reached, until)
    return total


def spans(events: Rows, starts: str, ends: str, last: int) -> list[tuple[int, int]]:
    found, since = [], None
    for event in events:
        if event["type"] == starts and since is None:
            since = int(event["at_ms"])
        elif event["type"] == ends and since is not None:
            found.append((since, int(event["at_ms"])))
            since = None
    return found if since is None else [*found, (since, last)]


def recomputed(flips: Rows, hints: Rows, events: Rows) -> dict[str, str]:
    flips = [flip for flip in flips if flip["stage"] == "game"]
    events = [event for event in events if event["stage"] == "game"]
    matches = [flip for flip in flips if flip["matched"] == "true"]
    first = [hint for hint in hints if hint["move_card"] == "first"]
    followed = [hint for hint in hints if hint["followed"] == "true"]
    led = [hint for hint in first if hint["followed"] == hint["move_matched"] == "true"]
    begin = int(flips[0]["at_ms"]) if flips else 0
    end = int(matches[-1]["at_ms"]) if matches else begin
    paused = spans(events, "PauseRequested", "PauseEnded", end)
    spoken = spans(events, "HintGiven", "BoardUnlocked", end)
    with_speech = end - begin - within(paused, begin, end)
    completion = end - begin - within([*paused, *spoken], begin, end)
    return {
        "flips": text(len(flips)),
        "moves": text(len(flips) // 2),
        "pairs": text(len(matches)),
        "hints": text(len(hints)),
        "completion_ms": text(completion),
        "completion_with_speech_ms": text(with_speech),
        "per_match_ms": text(share(completion, len(matches))),
        "per_match_with_speech_ms": text(share(with_speech, len(matches))),
        "assistance_per_flip": text(share(sum(LEVELS[hint["action"]] for hint in hints), len(flips))),
        "followed_rate": text(share(len(followed), len(hints))),
        "first_followed_rate": text(share(sum(hint in followed for hint in first), len(first))),
        "first_led_to_match_rate": text(share(len(led), len(first))),
    }


def test_every_measure_of_the_game_comes_out_of_the_flips_hints_and_events(read: Read) -> None:
    flips, hints, events = (by_participant(read(table)) for table in ("flips", "hints", "events"))
    people = read("participants")
    assert len(people) == PARTICIPANTS
    for person in people:
        of = person["participant_id"]
        measured = recomputed(flips[of], hints[of], events[of])
        assert {name: person[name] for name in measured} == measured
    # They are all kinds of people, or the comparison would say little.
    assert {person["game_completed"] for person in people} == {"true", "false"}
    assert len({person["condition"] for person in people}) == 5
    assert any(person["pauses"] != "0" for person in people)
    assert any(int(person["completion_ms"]) < int(person["completion_with_speech_ms"]) for person in people)


def test_a_target_is_one_of_the_cards_that_the_rule_allowed_and_a_decision_the_greedy_one(read: Read) -> None:
    hints, decisions = read("hints"), read("decisions")
    for hint in hints:
        assert float(hint["target_probability"]) == pytest.approx(1 / int(hint["allowed_cards"]), abs=1e-6)
        assert hint["move_card"] == "first" or hint["allowed_cards"] == "1"
    assert any(int(hint["allowed_cards"]) > 1 for hint in hints)
    for decision in decisions:
        assert (decision["greedy_action"], decision["randomised"]) == (decision["action"], "false")
        assert float(decision["action_probability"]) == 1


def test_every_scale_comes_out_of_the_answers(read: Read) -> None:
    answers, scores = by_participant(read("answers")), by_participant(read("scores"))
    sums = 0
    for person in read("participants"):
        of = person["participant_id"]
        for scale in ("SOC", "AC", "PC", "RC"):
            asked = [answer for answer in answers[of] if answer["scale"] == scale]
            values = [
                6 - int(answer["value"]) if answer["reversed"] == "true" else int(answer["value"])
                for answer in asked
                if answer["value"]
            ]
            total = text(sum(values) if len(values) == len(asked) == 4 else None)
            mean = text(fmean(values) if values else None)
            assert (person[f"{scale}_sum"], person[f"{scale}_mean"]) == (total, mean)
            score = next(score for score in scores[of] if score["scale"] == scale)
            assert (score["sum"], score["mean"], score["answered"]) == (total, mean, str(len(values)))
            sums += bool(total)
    assert sums > 60


def test_the_values_that_count_are_those_of_the_last_answers_in_the_events(read: Read) -> None:
    given: dict[tuple[str, str, str], object] = {}
    asking = ""
    for event in read("events"):
        fields = json.loads(event["fields"])
        if event["type"] == "QuestionnairePageShown":
            asking = fields["questionnaire"]
        if event["type"] == "ResponseGiven" and "value" in fields:
            given[event["participant_id"], asking, fields["item"]] = fields["value"]
    told = {
        (row["participant_id"], row["questionnaire"], row["item"]): row["value"]
        for row in read("answers")
        if row["kind"] != "text"
    }
    assert {key for key, value in told.items() if value} == {key for key, value in given.items() if value}
    for key in given.keys() & told.keys():
        value = given[key]
        assert told[key] == (";".join(value) if isinstance(value, list) else "" if value is None else str(value))


def test_the_flow_adds_up_to_the_participants(read: Read) -> None:
    people, flow = read("participants"), read("flow")
    for condition in {person["condition"] for person in people}:
        exported = next(row for row in flow if (row["quantity"], row["group"]) == ("exported", condition))
        assert int(exported["count"]) == sum(person["condition"] == condition for person in people)
    ended = sum(int(row["count"]) for row in flow if row["quantity"] == "ended_at")
    assert ended == sum(person["status"] != "completed" for person in people) > 0


def test_a_decision_takes_as_long_as_the_board_was_open_before_it(read: Read) -> None:
    events = by_participant(read("events"))
    for of, flips in by_participant(read("flips")).items():
        paused = spans(events[of], "PauseRequested", "PauseEnded", 0)
        opened = {"BoardDealt", "CardFlipped", "BoardUnlocked"}
        times = [
            int(event["at_ms"])
            for event in events[of]
            if event["type"] in opened or event["fields"] == '{"timer":"turn_back"}'
        ]
        for flip in flips:
            at = int(flip["at_ms"])
            since = max(time for time in times if time < at)
            assert int(flip["decision_ms"]) == at - since - within(paused, since, at)


def test_a_card_lies_open_until_it_is_turned_back_or_its_pair_is_found(read: Read) -> None:
    events = by_participant(read("events"))
    measured = 0
    for of, flips in by_participant(read("flips")).items():
        paused = spans(events[of], "PauseRequested", "PauseEnded", 0)
        turned_back = [int(e["at_ms"]) for e in events[of] if e["fields"] == '{"timer":"turn_back"}']
        for flip in flips:
            if not flip["exposure_ms"]:
                continue
            measured += 1
            at = int(flip["at_ms"])
            last = next(f for f in flips if (f["board"], f["move"]) == (flip["board"], flip["move"]) and f["matched"])
            until = int(last["at_ms"])
            if last["matched"] == "false":
                until = next(time for time in turned_back if time > until)
            assert int(flip["exposure_ms"]) == until - at - within(paused, at, until)
    assert measured > 1000


def test_a_hold_lasts_from_the_sentence_until_the_board_opens(read: Read) -> None:
    held = [hint for hint in read("hints") if hint["opened_ms"]]
    assert held
    assert all(int(hint["hold_ms"]) == int(hint["opened_ms"]) - int(hint["given_ms"]) for hint in held)
