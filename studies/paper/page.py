"""The page ``docs/paper.md``: everything on it follows from the results."""

from collections.abc import Mapping, Sequence

from studies.paper.bands import Band
from studies.paper.hypotheses import hypotheses
from studies.paper.quantity import Origin, Quantity, error_text, model_text, paper_text, verdict
from studies.paper.section import Section, table

IMAGES = "images/paper"
HEADER = ["quantity", "paper", "model", "error", "origin", "verdict"]
INTRODUCTION = """# The paper, reproduced

Written by `make paper`; do not edit. Every experiment of *MagWorm* (Soft Robotics, DOI
[10.1089/soro.2019.0167](https://doi.org/10.1089/soro.2019.0167)) that the planar model can repeat, simulated
from the presets. The paper's table of parameters is not public: the presets were identified from some of its
figures, marked *identification target* and *fitted trend* below; agreement there shows that the
identification worked, not that the model is right. `paper-3`, `paper-4` and `paper-5` are one robot, that of
the experiment: how it was found, and how much those figures leave open, is told in
[identification/paper-joint.md](identification/paper-joint.md). `paper-3-simulation` is the model of the
paper's simulation, told in [identification/paper-3-simulation.md](identification/paper-3-simulation.md).
*Held back* are figures that were not used; they test the model. *Closed form* tests the program. Where the
paper uses words, the way they are read stands in brackets. Bands of all figures, and why, are in
`studies/paper/bands.toml`; `make paper` fails where one is left.
"""


def page(sections: Sequence[Section], bands: Mapping[str, Band]) -> str:
    """The page as Markdown.

    Args:
        sections: What the experiments found.
        bands: Allowed values by key; a figure without a band counts as outside.
    """
    quantities = [quantity for section in sections for quantity in section.quantities]
    parts = [INTRODUCTION, _summary(quantities, bands), overview(quantities, bands), hypotheses(quantities)]
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
    fitted, held = (_against(quantities, origin) for origin in (Origin.FITTED, Origin.HELD_BACK))
    return (
        f"Of {len(targets)} identification targets {sum(targets)} are met; of {len(exact)} exact results "
        f"{sum(exact)} are. Of {fitted[1]} trends that were fitted the model disagrees with {fitted[0]}, of "
        f"{held[1]} figures and statements held back with {held[0]}; with the others it agrees or comes "
        "close.\n"
    )


def _against(quantities: Sequence[Quantity], origin: Origin) -> tuple[int, int]:
    """How many listed rows of an origin the model disagrees with, and of how many."""
    verdicts = [verdict(q, True) for q in quantities if q.origin is origin and q.listed]
    return sum(words.startswith("**") for words in verdicts), len(verdicts)
