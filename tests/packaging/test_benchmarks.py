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


def test_a_day_is_written_below_the_rest_of_the_page_and_is_kept_when_the_rest_is_written() -> None:
    benchmarks = load("benchmarks")
    told = {
        "date": "2026-12-01",
        "memory": {"first": 151, "last": 600, "slope_kib": 0.42, "error_kib": 0.66, "handles": 15},
        "gaps": {"visitors": 200, "speed": 10, "beats": 623_039, "p99_ms": 10.2, "longest_ms": 48.3},
        "shares": {"start_screen": 0.054, "game_at_rest": 0.013},
    }
    section = benchmarks.day(told)
    assert "| memory a visitor, visitors 151 to 600 | +0.4 ± 0.7 KiB |" in section
    assert "| 99 of 100 gaps are below, 200 visitors, 10 x speed | 10.2 ms |" in section
    assert "| the longest of 623,039 gaps | 48.3 ms |" in section
    assert "| the start screen, of one core | 5.4% |" in section
    rest = "# Benchmarks\n\nA table.\n"
    assert benchmarks.divided(rest) == (rest, "")
    assert benchmarks.divided(rest + section) == (rest, section)


def test_a_part_of_a_day_can_be_measured_alone() -> None:
    told = {"date": "2026-12-01", "shares": {"start_screen": 0.054, "game_at_rest": 0.013}}
    section = load("benchmarks").day(told)
    assert "| a game at rest, of one core | 1.3% |" in section
    assert "memory a visitor" not in section


def test_taps_are_told_beside_their_references() -> None:
    percentiles = {"p50_us": 8000.0, "p99_us": 12_000.0}
    names = ("tap_to_first_changed_frame", "durable_event", "decision[tom]", "decision[notom]")
    told = {f"test_{name}": percentiles for name in (*names, "frame_time_while_cards_turn", "arrival_of_the_board")}
    told["test_tap_to_first_changed_frame_of_one_square"] = {"p50_us": 10_000.0, "p99_us": 12_000.0}
    told["test_durable_event_beside_a_bare_commit"] = {"bare_p25_us": 1000.0, "ours_p25_us": 1200.0, "ratio": 1.2}
    told["test_cost_of_the_start_screen"] = {"share of one core": 0.025}
    section = load("benchmarks").taps(told)
    assert "| from a tap to the first changed frame | 8 ms | 12 ms | 10 ms | 0.80 |" in section
    assert "| writing a tap and its flip to the disk | 8 ms | 12 ms | 1 ms | 1.20 |" in section
    assert "| a frame while two cards turn | 8 ms | 12 ms |  |  |" in section
    assert "takes 2.5% of one core" in section
    told.pop("test_durable_event")
    assert load("benchmarks").taps(told) == ""
