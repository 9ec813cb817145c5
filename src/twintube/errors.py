"""What all errors of a user's input have in common."""


class UserError(Exception):
    """An input that cannot be used: the message is one line that names quantity, value and allowed range."""
