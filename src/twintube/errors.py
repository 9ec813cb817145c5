"""What all errors and warnings about a user's input have in common."""


class UserError(Exception):
    """An input that cannot be used: the message is one line that names quantity, value and allowed range."""


class InputWarning(UserWarning):
    """An input that can be used but is hardly meant; the message is one line like that of an error.

    Commands print it on standard error as `warning: ...`.
    """
