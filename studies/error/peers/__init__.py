"""Other simulators on the cases of the study, where they are installed: `pip install '.[rivals]'`."""
