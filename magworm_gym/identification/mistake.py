"""What is wrong with a problem, in one sentence."""


class ProblemError(ValueError):
    """A mistake in a problem, a track file or an output folder that its author can mend.

    The message is one sentence: where, the value, what is allowed.
    """
