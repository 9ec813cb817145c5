"""What switches parts of the model off: the model variants 2 and 3 of Section 3.4."""

NO_FOAM = {"S_BV": 0.0, "S_PV": 0.0}
NO_CAVITATION = {"Y_Co_cav": 0.0, "Y_Re_cav": 0.0}
