"""A model drafts the words of hints, checks refuse what is wrong, and a study only speaks what was signed."""

from __future__ import annotations

import json
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import date
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from kiosk import UserInputError
from kiosk.assistance.claims import histories
from kiosk.assistance.mentaliser import HintReason
from kiosk.assistance.policy import FlipInMove
from kiosk.assistance.wording import Catalogue
from kiosk.cli.study_wording import wording
from kiosk.config import Settings
from kiosk.experiment.session_config import StudyConfig
from kiosk.robots.language_model import LanguageModel
from kiosk.study.checks import wording_check
from kiosk.study.loader import read_study
from kiosk.study.wording_drafts import (
    Candidate,
    Checker,
    Draft,
    Drafter,
    State,
    hint_messages,
    prompt,
    read_signed,
    sign_wording,
    wordings_in,
)
from tests.patience import PATIENCE_S
from tests.samples import ANIMALS, CATALOGUES, ENGLISH

TODAY = date(2026, 5, 9)
SEEN_ONCE = "You have met one { $card } card once, and the other not yet."
CHECKER = Checker(ENGLISH, ANIMALS, 6)


@contextmanager
def serving(answer: bytes, status: int = 200) -> Iterator[tuple[str, list[dict[str, object]]]]:
    """Answer every request like this; gives the address and what was asked."""
    asked: list[dict[str, object]] = []

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            asked.append(json.loads(self.rfile.read(int(self.headers["Content-Length"]))))
            self.send_response(status)
            self.end_headers()
            self.wfile.write(answer)

        def log_message(self, *_: object) -> None:
            """Keep the tests' output clean."""

    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    thread = threading.Thread(target=server.serve_forever, args=(0.01,), daemon=True)
    thread.start()
    try:
        yield f"http://127.0.0.1:{server.server_address[1]}/v1", asked
    finally:
        server.shutdown()
        thread.join(PATIENCE_S)
        server.server_close()


def saying(text: str) -> bytes:
    """Return the answer of a model."""
    return json.dumps({"model": "tiny", "choices": [{"message": {"content": text}}]}).encode()


def drafted(*candidates: Candidate, message: str = "reason-first-one-seen-once") -> Draft:
    """Return a draft of one message."""
    return Draft("en", "warm", "tiny", "2026-05-01", {message: list(candidates)})


def study(folder: Path, text: str = 'languages = ["en"]\n') -> Path:
    """Write a study file."""
    file = folder / "study.toml"
    file.write_text(text, "utf-8")
    return file


def read(folder: Path, more: str = "") -> StudyConfig:
    """Read a study with the wording of its folder."""
    return read_study(Settings.read(study(folder, f'languages = ["en"]\n[assistance]\nwording = "./wording"\n{more}')))


def signed(folder: Path) -> Path:
    """Sign one wording, and return its folder."""
    place = folder / "wording"
    draft = drafted(Candidate(SEEN_ONCE, state=State.TAKEN))
    draft.write(place)
    sign_wording(place, [draft], "Ada  Byron", TODAY)
    return place


# What is checked


def shipped_lines(catalogue: Catalogue, message: str) -> Iterator[str]:
    """Yield the wordings of a message that are written in one line."""
    for line in catalogue.written[message].text.splitlines():
        name, _, text = line.partition(" = ")
        if name.strip().startswith(".") and "->" not in text:
            yield text


@pytest.mark.parametrize("language", ["en", "it", "es"])
def test_every_shipped_wording_passes_the_checks(language: str) -> None:
    catalogue = CATALOGUES[language]
    checker = Checker(catalogue, ANIMALS[:3], 6)
    assert len(hint_messages(catalogue)) == 18
    for message in hint_messages(catalogue):
        texts = [*shipped_lines(catalogue, message)]
        assert texts
        for text in texts:
            assert not checker.faults(message, text), (message, text)


@pytest.mark.parametrize(
    ("message", "text", "why"),
    [
        ("reason-first-one-seen-once", "You have seen both { $card } cards.", "does not say that a card was never"),
        ("reason-first-both-seen-once", "You have never seen a { $card } card.", "says that a card was never"),
        ("reason-first-both-often", "You have seen both { $card } cards.", "not say that a card was turned up more"),
        ("reason-first-both-seen-once", "Both { $card } cards were up more than once.", "turned up more than once"),
        ("reason-first-both-often", "Both { $card } cards were up at least twice, one once.", "turned up once"),
        ("reason-second-both-often", "This { $card } card is new, its mate was up more than once.", "open card is new"),
        ("reason-second-first-sight", "You have seen this { $card } card, never its mate.", "open card was up before"),
        ("reason-first-both-often", "Both { $card } cards were up 2 times, more than once.", "figure"),
        ("reason-first-both-often", "Both { $cards } were up more than once.", "does not exist"),
        ("reason-first-both-often", "Both { $card } cards were up more than once { .", "not well-formed"),
        ("reason-first-both-often", "Both { $card } cards, and the frog, were up more than once.", "another card, fro"),
        ("reason-first-both-often", "Both { $card } cards were up more than once, " + "truly " * 20, "longer than"),
        ("reason-first-nothing-known", "Never seen yet: the { $card } cards.", "knows nothing"),
        ("point-first-row", "Try row five.", "lacks { $row }"),
        ("point-first-row", "Try row { $row }, column two.", "not speak of a column"),
        ("point-first-card", "Try row { $column }, column { $row }.", "must say 'row"),
        ("point-first-row", "Row { $row }\n    .b = Or row { $row }", "one line"),
    ],
)  # fmt: skip
def test_a_wording_is_refused_with_the_reason(message: str, text: str, why: str) -> None:
    assert why in " ".join(CHECKER.faults(message, text))


def test_a_claim_is_checked_for_every_history_that_a_message_stands_for() -> None:
    assert histories(FlipInMove.FIRST, HintReason.OFTEN_AND_NEVER) == ((0, 2), (0, 3), (2, 0), (3, 0))
    assert histories(FlipInMove.SECOND, HintReason.BOTH_SEEN_ONCE) == ((1, 1),)


def test_a_language_without_phrases_gets_all_checks_but_that_of_truth() -> None:
    dutch = Checker(Catalogue(Path("nl"), ENGLISH.sources), ANIMALS, 6)
    assert not dutch.checks_claims
    assert not dutch.faults("reason-first-both-often", "Beide { $card } kaarten ken je.")
    assert dutch.faults("reason-first-both-often", "Beide { $kaart } kaarten ken je.")


# The model


def test_a_model_sees_placeholders_and_answers_in_lines() -> None:
    system, user = prompt("point-first-row", ENGLISH, "warm", 4)
    assert "{row}" in user
    assert "warm" in user
    assert "placeholder" in system
    answer = 'Here are some:\n1. Try row {row}.\n- "Look at row { $row }."\n\nTry row {row}.\nOne more row {row}.'
    assert wordings_in(answer, 2) == ["Try row { $row }.", "Look at row { $row }."]


def test_the_server_is_asked_for_a_chat() -> None:
    with serving(saying("Hello")) as (address, asked):
        model = LanguageModel(address)
        assert model.ask("Be kind.", "Say hello.", seed=7) == "Hello"
    assert model.name == "tiny"
    assert asked[0]["seed"] == 7
    assert asked[0]["messages"] == [
        {"role": "system", "content": "Be kind."},
        {"role": "user", "content": "Say hello."},
    ]


@pytest.mark.parametrize(
    ("address", "why"),
    [
        ("example.org", "looks like http://"),
        ("http://example.org/v1", "on this machine"),
        ("http://me:secret@127.0.0.1/v1", "password"),
        ("ftp://127.0.0.1/v1", "looks like http://"),
    ],
)
def test_only_a_server_on_this_machine_is_asked(address: str, why: str) -> None:
    with pytest.raises(UserInputError, match=why) as refused:
        LanguageModel(address)
    assert "secret" not in str(refused.value)


@pytest.mark.parametrize(
    ("answer", "status", "why"),
    [
        (b"no JSON", 200, "not answer like"),
        (b'{"choices": []}', 200, "not answer like"),
        (b'{"choices": [{"message": {"content": null}}]}', 200, "not answer like"),
        (b"", 500, "answers with 500"),
        (b"x" * (1 << 21), 200, "more than"),
    ],
)
def test_an_answer_of_another_kind_gets_a_sentence(answer: bytes, status: int, why: str) -> None:
    with serving(answer, status) as (address, _), pytest.raises(UserInputError, match=why):
        LanguageModel(address).ask("", "", seed=1)


def test_a_server_that_is_not_there_gets_a_sentence() -> None:
    with serving(b"") as (address, _):
        pass
    with pytest.raises(UserInputError, match=r"does not answer .*is it running"):
        LanguageModel(address).ask("", "", seed=1)


# From a draft to what is spoken


def call(*arguments: str | Path, typed: str = "") -> Result:
    """Run a command in this process."""
    return CliRunner().invoke(wording, [str(each) for each in arguments], input=typed)


def test_a_draft_is_reviewed_signed_and_spoken(tmp_path: Path) -> None:
    file = study(tmp_path)
    with serving(saying(SEEN_ONCE)) as (address, asked):
        made = call("draft", file, "--server", address, "--json")
    assert made.exit_code == 0, made.output
    assert len(asked) == 18
    found = json.loads(made.output)
    # It is true of a first card of which one was seen once, and of a second card whose mate was never seen.
    assert (found["wordings"], found["sound"]) == (18, 2)

    reviewed = call("review", file, typed="t\nl\n")
    assert "1 taken, 17 left, 0 undecided" in reviewed.output
    ended = call("sign", file, "--name", "Ada Byron")
    assert 'wording = "./wording"' in ended.output

    spoken = read(tmp_path)
    (said,) = spoken.plans[0].catalogue.wordings("reason-first-one-seen-once", card="lion")
    assert said == "You have met one lion card once, and the other not yet."
    assert spoken.plans[0].catalogue.wordings("reason-first-both-often", card="lion") == ENGLISH.wordings(
        "reason-first-both-often", card="lion"
    )
    assert "signed by Ada Byron on" in next(wording_check(spoken)).message


def test_what_is_shipped_anyway_is_no_draft() -> None:
    shipped = "You have seen one { $card } card once, and the other one not yet."
    draft = drafted()
    draft.messages.clear()
    Drafter(ENGLISH, CHECKER, lambda _system, _user: f"{shipped}\n{SEEN_ONCE}", 1).add_to(
        draft, "reason-first-one-seen-once"
    )
    assert draft.messages == {"reason-first-one-seen-once": [Candidate(SEEN_ONCE)]}


def test_an_interrupted_draft_goes_on(tmp_path: Path) -> None:
    file = study(tmp_path)
    with serving(b"no JSON") as (address, _):
        assert isinstance(call("draft", file, "--server", address).exception, UserInputError)
    place = tmp_path / "wording"
    assert Draft.read(place, "en") is None
    drafted(Candidate(SEEN_ONCE)).write(place)
    with serving(saying("Anything.")) as (address, asked):
        assert call("draft", file, "--server", address, "--style", "warm").exit_code == 0
    assert len(asked) == 17
    kept = Draft.read(place, "en")
    assert kept is not None
    assert kept.messages["reason-first-one-seen-once"] == [Candidate(SEEN_ONCE)]


def test_what_fails_a_check_cannot_be_taken(tmp_path: Path) -> None:
    file = study(tmp_path)
    drafted(Candidate("You have seen both { $card } cards.")).write(tmp_path / "wording")
    refused = call("review", file, "--take", "reason-first-one-seen-once.1")
    assert "cannot be taken: it does not say that a card was never turned up" in str(refused.exception)


def test_a_wording_that_was_changed_by_hand_is_checked_before_it_is_signed(tmp_path: Path) -> None:
    file = study(tmp_path)
    drafted(Candidate("You have seen both { $card } cards.", state=State.TAKEN)).write(tmp_path / "wording")
    refused = call("sign", file, "--name", "Ada")
    assert "en: reason-first-one-seen-once.1: it does not say" in str(refused.exception)


@pytest.mark.parametrize(
    ("candidate", "name", "why"),
    [
        (Candidate(SEEN_ONCE), "Ada", "neither taken nor left"),
        (Candidate(SEEN_ONCE, state=State.LEFT), "Ada", "nothing to sign"),
        (Candidate(SEEN_ONCE, state=State.TAKEN), "  ", "who signs"),
    ],
)
def test_nothing_is_signed_before_everything_is_decided(
    tmp_path: Path, candidate: Candidate, name: str, why: str
) -> None:
    with pytest.raises(UserInputError, match=why):
        sign_wording(tmp_path, [drafted(candidate)], name, TODAY)
    assert not [*tmp_path.iterdir()]


def test_a_study_does_not_speak_what_changed_after_it_was_signed(tmp_path: Path) -> None:
    place = signed(tmp_path)
    assert read_signed(place).name == "Ada Byron"
    file = place / "en.ftl"
    file.write_text(file.read_text("utf-8").replace("met one", "seen one"), "utf-8")
    with pytest.raises(UserInputError, match=r"en\.ftl is not what Ada Byron signed on 2026-05-09"):
        read(tmp_path)


@pytest.mark.parametrize(
    ("change", "why"),
    [
        (lambda place: (place / "signed.toml").unlink(), "is not signed"),
        (lambda place: (place / "signed.toml").write_text("name = 1"), "is damaged"),
        (lambda place: (place / "it.ftl").write_text("a = b"), "it.ftl is not what"),
        (lambda place: (place / "en.ftl").unlink(), "en.ftl is not what"),
    ],
)
def test_a_folder_that_is_not_signed_as_it_is_gets_a_sentence(tmp_path: Path, change: object, why: str) -> None:
    assert callable(change)
    change(signed(tmp_path))
    with pytest.raises(UserInputError, match=why):
        read(tmp_path)


def test_a_message_is_not_replaced_twice(tmp_path: Path) -> None:
    signed(tmp_path)
    own = '[texts.en.reason-first-one-seen-once]\na = "Never mind { $card }."\n'
    with pytest.raises(UserInputError, match="replaces the message reason-first-one-seen-once, too"):
        read(tmp_path, own)


def test_every_language_of_a_study_needs_signed_words(tmp_path: Path) -> None:
    signed(tmp_path)
    file = study(tmp_path, 'languages = ["en", "it"]\n[assistance]\nwording = "./wording"\n')
    with pytest.raises(UserInputError, match="signed for the language 'it'"):
        read_study(Settings.read(file))
