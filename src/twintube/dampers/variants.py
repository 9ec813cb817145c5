"""Variants of the model: parts of it switched off (variants 2 and 3 of Section 3.4), or a scalar factor in its place."""

NO_FOAM = {"S_BV": 0.0, "S_PV": 0.0}
NO_CAVITATION = {"Y_Co_cav": 0.0, "Y_Re_cav": 0.0}


def scalar_factor(factor: float) -> dict[str, float]:
    """The parameters that scale the fluid force of a full damper: the usual shortcut for a worn one."""
    return {"oil_level": 1.0, "wear_re": factor - 1.0, "wear_co": factor - 1.0}
