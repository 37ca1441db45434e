"""Tables, where other studies still look for them."""

from studies.kit.page import table

__all__ = ["table"]
