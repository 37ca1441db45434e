"""Training of policies, and their comparison with other drives. Needs the extra ``magworm-gym[train]``."""
