"""The search for the weakest strength at which a cause is found."""

from benchmarks.diagnosis import given_up, limit, undecided


def test_the_detection_limit_is_sought_at_the_weakest_strength_and_then_by_bisection() -> None:
    assert undecided({}) == 0.0625
    assert undecided({0.0625: 0.9}) is None
    assert undecided({0.0625: 0.8}) == 0.25
    assert undecided({0.0625: 0.8, 0.25: 0.7}) == 0.5
    assert undecided({0.0625: 0.8, 0.25: 0.9, 0.125: 0.8}) is None
    assert limit({0.0625: 0.8, 0.25: 0.9, 1.0: 1.0}) == 0.25
    assert given_up([True, False, False], 10)
    assert not given_up([True, False], 10)
