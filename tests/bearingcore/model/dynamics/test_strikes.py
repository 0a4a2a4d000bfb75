"""Flights and strikes of balls, read off their loads."""

import numpy as np

from bearingcore.model.dynamics import Flight, Strike, ball_strikes, flights

TIME = 0.1 * np.arange(10)


def loads(inner: list[float], outer: list[float]) -> np.ndarray:
    """(2, 10, 1) of one ball."""
    return np.array([inner, outer], dtype=float)[:, :, None]


def test_a_ball_flies_where_it_touches_neither_race_and_strikes_where_it_comes_down() -> None:
    inner = [5, 4, 0, 0, 0, 0, 0, 0, 3, 3]
    outer = [5, 4, 2, 0, 0, 0, 7, 8, 6, 0]
    assert flights(TIME, loads(inner, outer)) == (Flight(0, TIME[3], TIME[5]),)
    assert ball_strikes(TIME, loads(inner, outer)) == (
        Strike(0, "outer", TIME[6], 8.0, TIME[7]),
        Strike(0, "inner", TIME[8], 3.0, TIME[8]),
    )


def test_balls_are_told_apart() -> None:
    two = np.concatenate([loads([1] * 10, [0] * 5 + [2] * 5), loads([0] * 10, [0] * 10)], axis=2)
    assert [flight.ball for flight in flights(TIME, two)] == [1]
    assert [strike.ball for strike in ball_strikes(TIME, two)] == [0]
