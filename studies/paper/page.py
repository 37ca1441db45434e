"""The page ``docs/paper.md``: everything on it follows from the results."""

from collections.abc import Mapping, Sequence

from studies.paper.bands import Band
from studies.paper.quantity import Origin, Quantity, error_text, model_text, paper_text, verdict
from studies.paper.section import Section, table

IMAGES = "images/paper"
HEADER = ["quantity", "paper", "model", "error", "origin", "verdict"]
INTRODUCTION = """# The paper, reproduced

Written by `make paper`; do not edit. Every experiment of *MagWorm* (Soft Robotics, DOI
[10.1089/soro.2019.0167](https://doi.org/10.1089/soro.2019.0167)) that the planar model can repeat, simulated
from the presets. The paper's table of parameters is not public: the presets were identified from a few of its
figures, marked *identification target* below; agreement there shows that the identification worked, not that
the model is right. How it was done, and how much those figures leave open, is told in
[identification/paper-3.md](identification/paper-3.md) and, for the variant of the experiment, in
[identification/paper-3-experiment.md](identification/paper-3-experiment.md). *Held back* are figures that
were not used; they test the model. *Closed form* tests the program. Where the paper uses words, the way they
are read stands in brackets. Bands of all figures, and why, are in `studies/paper/bands.toml`; `make paper`
fails where one is left.
"""


def page(sections: Sequence[Section], bands: Mapping[str, Band]) -> str:
    """The page as Markdown.

    Args:
        sections: What the experiments found.
        bands: Allowed values by key; a figure without a band counts as outside.
    """
    quantities = [quantity for section in sections for quantity in section.quantities]
    parts = [INTRODUCTION, _summary(quantities, bands), overview(quantities, bands)]
    for section in sections:
        parts += [f"\n## {section.title}\n", section.text]
        parts += [
            f"\n![{image.caption}]({IMAGES}/{image.name}.png)\n\n*{image.caption}*"
            for image in section.images
        ]
    return "\n".join(parts) + "\n"


def overview(quantities: Sequence[Quantity], bands: Mapping[str, Band]) -> str:
    """The table of all figures that stand at the top."""
    rows = [
        [q.what, paper_text(q), model_text(q), error_text(q), q.origin.value, verdict(q, _inside(q, bands))]
        for q in quantities
        if q.listed
    ]
    return table(HEADER, rows)


def _inside(quantity: Quantity, bands: Mapping[str, Band]) -> bool:
    return quantity.key in bands and bands[quantity.key].holds(quantity.model)


def _summary(quantities: Sequence[Quantity], bands: Mapping[str, Band]) -> str:
    """How many comparisons went well, by what they prove."""
    targets = [_inside(q, bands) for q in quantities if q.origin is Origin.TARGET]
    exact = [_inside(q, bands) for q in quantities if q.origin is Origin.CLOSED_FORM]
    held = [verdict(q, True) for q in quantities if q.origin is Origin.HELD_BACK and q.listed]
    against = sum(words.startswith("**") for words in held)
    return (
        f"Of {len(targets)} identification targets {sum(targets)} are met; of {len(exact)} exact results "
        f"{sum(exact)} are. Of {len(held)} figures and statements held back, the model agrees with or comes "
        f"close to {len(held) - against} and disagrees with {against}.\n"
    )
