"""What all studies share: how they are run, measured, timed, written down and drawn.

A study measures and renders apart. ``measure`` runs the simulator, for minutes, and writes data that are
committed beside the study. ``render`` makes page and figures from these data alone, within a second, so that
words and figures can be mended without measuring again. A test renders every page and holds it against the
committed one, byte for byte, and every figure by what it draws.

.. code-block:: text

    studies/NAME/study.py       STUDY, a :class:`studies.kit.study.Study`; named in studies/__main__.py
    studies/NAME/page.md        the page as a Jinja2 template, which reads as Markdown
    studies/NAME/data/          what was measured: CSV for rows, JSON for all else

    python -m studies measure NAME [options]
    python -m studies render [NAME ...]

================  =====================================================================================
``study``         a study, and the command line of all
``data``          dataclasses to CSV and JSON and back, rounded
``page``          templates, tables in Markdown
``words``         numbers and words as pages print them
``figures``       one look for all figures; what a figure draws, as a fingerprint
``timing``        repeated wall and processor times; a stopwatch that says what has ended
``passes``        the robots of the presets and how a drive passes them
================  =====================================================================================
"""
