"""What is wrong with a policy."""


class PolicyError(ValueError):
    """A policy that cannot be used, or not for what it is asked to do: one sentence says why."""
