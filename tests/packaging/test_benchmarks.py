"""The page of benchmarks is made from what the benches say, whatever their parameters are."""

from __future__ import annotations

from tests.packaging.scripts import load


def test_only_sessions_are_counted_as_sizes() -> None:
    seconds = {
        "test_next_slot[100 sessions]": 0.001,
        "test_next_slot[1000 sessions]": 0.002,
        "test_listed[100 sessions-all]": 0.01,
        "test_listed[1000 sessions-all]": 0.1,
        "test_games_in_processes[2]": 0.5,
        "test_games_in_c": 0.25,
        "test_from_nothing_to_the_default_table[warm]": 1.1,
    }
    told = {
        "machine_info": {"cpu": {"brand_raw": "A processor"}, "machine": "x86_64", "python_version": "3.11.2"},
        "datetime": "2026-11-29T17:00:00",
        "load": 0.2,
        "benchmarks": [{"name": name, "stats": {"min": least}, "extra_info": {}} for name, least in seconds.items()],
    }
    page = load("benchmarks").page(told)
    assert "| next slot | 1 ms | 2 ms | 2.0 |" in page
    assert "| listed (all) | 10 ms | 100 ms | 10.0 |" in page
    assert "| the same in two processes | 80,000 | 1.00 |" in page
    assert "| warm | 1.1 s |" in page
