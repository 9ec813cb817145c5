"""`python -m twintube.cli`."""

from twintube.cli import app

app()
