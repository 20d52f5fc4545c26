"""What a benchmark tells beside its mean: the middle and the slow end of its raw times."""

from __future__ import annotations

from statistics import quantiles
from typing import Any


def tell_percentiles(benchmark: Any) -> None:
    """Add p50 and p99 of the raw times, in microseconds, to the benchmark's report, and print them."""
    cuts = quantiles(benchmark.stats.stats.data, n=100, method="inclusive")
    told = {f"p{percent}_us": round(cuts[percent - 1] * 1e6, 1) for percent in (50, 99)}
    benchmark.extra_info.update(told)
    print(f"\n{benchmark.name}: {told}")  # noqa: T201 - a benchmark is read on the terminal
