"""When a record or a damper counts as intact: the single definition for identification, diagnosis and their pages."""

INTACT_LEVEL = 0.995  # [1] of oil volume and gas preload: what rounds to 100 %


def is_intact(oil_level: float, gas_preload: float) -> bool:
    """Whether a damper with these shares of its oil and of its gas preload [1] is full."""
    return gas_preload >= INTACT_LEVEL and oil_level >= INTACT_LEVEL
