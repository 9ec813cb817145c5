"""What all errors and warnings about a user's input have in common."""


class UserError(Exception):
    """An input that cannot be used: the message is one line that names quantity, value and allowed range."""


class InputError(UserError, ValueError):
    """A record that cannot be simulated; the message names the quantity, the sample, the value and the range."""


class ParameterError(UserError, ValueError):
    """A parameter set that cannot be used; the message names file, line, quantity, value and allowed range."""


class InputWarning(UserWarning):
    """An input that can be used but is hardly meant; the message is one line like that of an error.

    Commands print it on standard error as `warning: ...`.
    """
