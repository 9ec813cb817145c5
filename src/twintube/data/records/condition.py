"""When a record or a damper counts as intact: the single definition for identification, diagnosis and their pages."""

INTACT_LEVEL = 0.995  # [1] of the oil volume: what rounds to 100 %


def is_intact(oil_level: float, gas_preload: bool | int) -> bool:
    """Whether a damper with this share of its oil [1] is full and has its gas preload."""
    return bool(gas_preload) and oil_level >= INTACT_LEVEL
