"""A language model on this machine, asked over HTTP while a study is prepared; never while a visitor plays."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any
from urllib.parse import urlsplit

import requests

from kiosk import UserInputError

LOOPBACK = frozenset({"localhost", "127.0.0.1", "::1"})
PATIENCE_S = 300
"""A small model on a slow machine takes its time for the first sentence."""
_LARGEST = 1 << 20


class LanguageModel:
    """An OpenAI-compatible server: ``POST <address>/chat/completions``."""

    def __init__(self, address: str, model: str = "") -> None:
        """Take an address such as ``http://127.0.0.1:8080/v1``; raises UserInputError for one of another machine."""
        parts = urlsplit(address)
        if parts.scheme not in {"http", "https"} or not parts.hostname:
            raise UserInputError(f"--server {address}: an address looks like http://127.0.0.1:8080/v1")
        if parts.username or parts.password:
            raise UserInputError("--server: a user or password in the address is not supported")
        if parts.hostname not in LOOPBACK:
            raise UserInputError(
                f"--server {address}: only a server on this machine is asked, such as http://127.0.0.1:8080/v1"
            )
        self._address = address.rstrip("/")
        self.name = model
        """What the model is called; empty before the first answer if no name was given."""

    def ask(self, system: str, user: str, *, seed: int, temperature: float = 0.8, most_tokens: int = 300) -> str:
        """Return the model's answer; raises UserInputError with what is wrong with the server or the answer."""
        body: dict[str, Any] = {
            "messages": [{"role": "system", "content": system}, {"role": "user", "content": user}],
            "temperature": temperature,
            "max_tokens": most_tokens,
            "seed": seed,
        }
        if self.name:
            body["model"] = self.name
        where = f"the server at {self._address}"
        try:
            with requests.Session() as session:
                # A proxy of the environment would carry the study's sentences off this machine.
                session.trust_env = False
                answer = session.post(
                    f"{self._address}/chat/completions", json=body, timeout=PATIENCE_S, allow_redirects=False
                )
        except requests.RequestException as error:
            raise UserInputError(f"{where} does not answer ({type(error).__name__}); is it running?") from error
        if answer.status_code != requests.codes.ok:
            raise UserInputError(f"{where} answers with {answer.status_code} {answer.reason}; look at its own messages")
        if len(answer.content) > _LARGEST:
            raise UserInputError(f"{where} answers with more than {_LARGEST} bytes")
        try:
            return self._read(answer.json())
        except (ValueError, LookupError, TypeError) as error:
            raise UserInputError(f"{where} does not answer like an OpenAI-compatible server") from error

    def _read(self, answer: Mapping[str, Any]) -> str:
        content = answer["choices"][0]["message"]["content"]
        if not isinstance(content, str):
            raise TypeError(content)
        self.name = self.name or str(answer.get("model") or "")
        return content
