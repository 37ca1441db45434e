"""What each effect of a scene costs, in instructions: ``docs/needs.md`` and the guard of the counts."""
