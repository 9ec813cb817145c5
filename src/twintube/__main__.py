"""`python -m twintube`: the command where its script is not on the path."""

from twintube.cli import app

app()
