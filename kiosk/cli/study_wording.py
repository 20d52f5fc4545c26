"""Commands that draft the sentences of hints with a language model, and freeze what a person signed."""

from __future__ import annotations

import json
from collections.abc import Iterable
from datetime import UTC, datetime
from pathlib import Path

import click
from rich.table import Table
from rich.text import Text

from kiosk import UserInputError
from kiosk.assistance.claims import CLAIM_PHRASES
from kiosk.cli.composition import read_settings
from kiosk.cli.options import json_option, progress_bar
from kiosk.cli.terminal import console, drop_typed_ahead, tell_line
from kiosk.config import Settings, code_of
from kiosk.experiment.session_config import SessionConfig
from kiosk.study.loader import read_study
from kiosk.study.wording_drafts import Checker, Draft, Drafter, State, hint_messages, sign_wording

FOLDER = "wording"
_ANSWERS = {"t": State.TAKEN, "l": State.LEFT}

file_argument = click.argument("file", type=click.Path(path_type=Path))
folder_option = click.option(
    "--folder", default=FOLDER, show_default=True, help="The folder of drafts and signed sentences, beside the study."
)
language_option = click.option("--language", help="The language; by default the first of the study.")


@click.group("wording")
def wording() -> None:
    """Draft, choose and sign other words for the hints."""


@wording.command("draft")
@file_argument
@language_option
@folder_option
@click.option("--server", required=True, help="An OpenAI-compatible server on this machine: http://127.0.0.1:8080/v1.")
@click.option("--model", default="", help="The model's name, if the server has several.")
@click.option("--style", default="warm and short", show_default=True, help="How the sentences are to sound.")
@click.option("--variants", type=click.IntRange(1, 10), default=4, show_default=True, help="Wordings of each message.")
@click.option("--seed", type=int, default=1, show_default=True, help="Where the model's chance begins.")
@json_option
def draft_command(
    *,
    file: Path,
    language: str | None,
    folder: str,
    server: str,
    model: str,
    style: str,
    variants: int,
    seed: int,
    as_json: bool,
) -> None:
    """Ask a language model for other wordings of hints.

    It asks for each hint of a study FILE, and checks the drafts.
    A run that was interrupted goes on with the messages that are missing; remove the draft file to begin anew.
    """
    # Only this command asks over HTTP, and its libraries take long to load.
    from kiosk.robots.language_model import LanguageModel  # noqa: PLC0415

    settings, plan = _read(file, language)
    place = settings.beside(folder)
    asked = LanguageModel(server, model)
    draft = Draft.read(place, plan.language) or Draft(plan.language, style, model, _today())
    if draft.style != style and draft.messages:
        raise UserInputError(
            f"the draft in {place} is in the style {draft.style!r}; remove it, or choose another folder"
        )
    missing = [message for message in hint_messages(plan.catalogue) if message not in draft.messages]
    numbered = iter(range(seed, seed + len(missing)))
    drafter = Drafter(
        plan.catalogue,
        _checker(plan),
        lambda system, user: asked.ask(system, user, seed=next(numbered)),
        variants,
    )
    with progress_bar("messages", len(missing), hidden=as_json) as tell:
        for done, message in enumerate(missing, 1):
            drafter.add_to(draft, message)
            draft.model = asked.name
            # After each one, so that an answer that took a minute is not lost with the next.
            draft.write(place)
            tell(done)
    sound = sum(not candidate.faults for candidates in draft.messages.values() for candidate in candidates)
    total = sum(map(len, draft.messages.values()))
    if as_json:
        click.echo(json.dumps({"folder": str(place), "language": plan.language, "wordings": total, "sound": sound}))
        return
    tell_line(f"{total} wordings of {len(draft.messages)} messages are in {place}; {sound} pass the checks.")
    tell_line(f"Next: recollect study wording review {file}{_option('language', language)}")


@wording.command("review")
@file_argument
@language_option
@folder_option
@click.option("--take", multiple=True, metavar="MESSAGE.NUMBER", help="Take a wording without being asked.")
@click.option("--leave", multiple=True, metavar="MESSAGE.NUMBER", help="Leave a wording without being asked.")
@click.option("--list", "only_list", is_flag=True, help="Only show the drafts beside the shipped sentences.")
@json_option
def review_command(
    *,
    file: Path,
    language: str | None,
    folder: str,
    take: tuple[str, ...],
    leave: tuple[str, ...],
    only_list: bool,
    as_json: bool,
) -> None:
    """Show the drafts, and accept or reject each.

    They are shown beside the shipped sentences of a study FILE.
    Wordings that failed a check cannot be accepted. A message without an accepted wording keeps its shipped ones.
    """
    settings, plan = _read(file, language)
    place = settings.beside(folder)
    draft = _draft(place, plan.language)
    # The study's cards may have changed since, and the file is open to editors.
    failed = draft.check(_checker(plan))
    for sentence in failed:
        tell_line(f"left, though it was taken: {sentence}", err=True)
    _decide(draft, State.TAKEN, take)
    _decide(draft, State.LEFT, leave)
    if not (take or leave or only_list or as_json):
        _ask(draft, plan, place)
    elif take or leave:
        draft.write(place)
    if as_json:
        click.echo(json.dumps(draft.as_dict()["messages"], ensure_ascii=False))
        return
    for message in draft.messages if only_list else ():
        _show(draft, message, plan)
    counts = {state: len(draft.of_state(state)) for state in State}
    click.echo(f"{counts[State.TAKEN]} taken, {counts[State.LEFT]} left, {counts[State.OPEN]} undecided.")
    if not counts[State.OPEN]:
        tell_line(f'Next: recollect study wording sign {file} --name "Your Name"')


@wording.command("sign")
@file_argument
@folder_option
@click.option("--name", required=True, help="Who has read the sentences and answers for them.")
@json_option
def sign_command(file: Path, folder: str, name: str, *, as_json: bool) -> None:
    """Freeze the accepted wordings of a study FILE.

    They are stored with your name, the date and hashes.
    """
    settings = read_settings(file)
    place = settings.beside(folder)
    plans = {plan.language: plan for plan in read_study(_without_wording(settings)).plans}
    drafts = [_draft(place, language) for language in plans]
    for draft in drafts:
        failed = draft.check(_checker(plans[draft.language]))
        if failed:
            raise UserInputError(*failed)
    signed = sign_wording(place, drafts, name, datetime.now(UTC).astimezone().date())
    if as_json:
        click.echo(json.dumps({"folder": str(place), "name": signed.name, "sha256": signed.sha256}))
        return
    tell_line(f"{place} is signed by {signed.name}: {signed.sha256}")
    if not settings.assistance.wording:
        tell_line(f"To use it, put this into {file}:")
        click.echo("[assistance]")
        tell_line(f'wording = "./{folder}"')


def _read(file: Path, language: str | None) -> tuple[Settings, SessionConfig]:
    """Read a study with the shipped sentences, and the plan of one of its languages; raises UserInputError."""
    settings = read_settings(file)
    plans = {plan.language: plan for plan in read_study(_without_wording(settings)).plans}
    chosen = code_of(language) if language else next(iter(plans))
    if chosen not in plans:
        raise UserInputError(f"--language: the study has no language {chosen!r}; it has {', '.join(plans)}")
    return settings, plans[chosen]


def _without_wording(settings: Settings) -> Settings:
    """Return the settings without a wording, which may not be signed yet, or no more."""
    return settings.model_copy(update={"assistance": settings.assistance.model_copy(update={"wording": ""})})


def _checker(plan: SessionConfig) -> Checker:
    cards = sorted({*plan.deck, *plan.practice_deck})
    return Checker(plan.catalogue, cards, max(plan.settings.game.rows, plan.settings.game.columns))


def _draft(place: Path, language: str) -> Draft:
    draft = Draft.read(place, language)
    if draft is None:
        raise UserInputError(f"{place} has no draft in {language!r}; run 'recollect study wording draft' first")
    return draft


def _decide(draft: Draft, state: State, names: Iterable[str]) -> None:
    for name in names:
        message, _, number = name.rpartition(".")
        draft.decide(message, int(number) if number.isdecimal() else 0, state)


def _ask(draft: Draft, plan: SessionConfig, place: Path) -> None:
    """Go through what is undecided; each answer is kept at once."""
    if plan.language not in CLAIM_PHRASES:
        click.echo(f"No program can tell whether a sentence in {plan.language!r} is true: read each with its comment.")
    shown = None
    for message, number in draft.of_state(State.OPEN):
        if message != shown:
            _show(draft, message, plan)
            shown = message
        drop_typed_ahead()
        answer = click.prompt(
            f"{message}.{number} (t)ake, (l)eave, (q)uit", type=click.Choice(["t", "l", "q"]), show_choices=False
        )
        if answer == "q":
            break
        draft.decide(message, number, _ANSWERS[answer])
        draft.write(place)
    draft.write(place)


def _show(draft: Draft, message: str, plan: SessionConfig) -> None:
    """Draw the shipped wordings of a message and the drafted ones side by side."""
    table = Table(title=message, title_justify="left", expand=True)
    table.add_column("shipped", ratio=1)
    table.add_column("drafted", ratio=1)
    drafted = Text()
    for number, candidate in enumerate(draft.messages[message], 1):
        drafted.append(f"{number}. {candidate.text}", style="bold" if candidate.state is State.TAKEN else "")
        drafted.append(f" [{candidate.state}]" if candidate.state is not State.OPEN else "")
        drafted.append("".join(f"\n   - {fault}" for fault in candidate.faults) + "\n", style="dim")
    table.add_row(Text(plan.catalogue.written[message].text.partition("\n")[2]), drafted)
    console().print(table)


def _today() -> str:
    return f"{datetime.now(UTC).astimezone().date()}"


def _option(name: str, value: str | None) -> str:
    return f" --{name} {value}" if value else ""
