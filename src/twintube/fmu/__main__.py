"""`python -m twintube.fmu`: write the C of the tables anew, after a change of a variable or of a message."""

from twintube.fmu.tables import write

write()
