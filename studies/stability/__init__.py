"""What the simulator does with stiff and extreme scenes: the page ``docs/stability.md``.

Run ``python -m studies.stability``.
"""
