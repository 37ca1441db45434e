"""What part of a core's arithmetic peak a solver step reaches, and what bounds it: ``docs/peak.md``."""
