"""The one base of the errors that the command line shows in a line."""


class MicroslipError(Exception):
    """A request that cannot be met; the text says what, where and how to mend it."""
