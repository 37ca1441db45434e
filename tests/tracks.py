"""Files and problems of identifications that tests write."""

PASS = {"drive.motion": {"kind": "constant", "x_m": -0.05, "y_m": -0.022, "speed_m_s": 0.1}}
PARTS = ["head", "middle", "tail"]
SMALL = {"restarts": 1, "population": 4, "generations": 1, "scatter": 8, "rounds": 0}


def saved(path, rows, separator=","):
    path.write_text("\n".join(separator.join(row) for row in rows) + "\n", encoding="utf-8")
    return path


def entries(path="worm.csv", values=PASS, drive=None, **tracks):
    tracks = {
        "file": str(path),
        "metres_per_pixel": 1.5e-4,
        "frames_per_second": 60.0,
        "magnets": PARTS,
        **tracks,
    }
    return {
        "scene": "paper-3",
        "parameters": {"material.youngs_modulus_pa": {"low": 28600, "high": 76300}},
        "experiment": [
            {"name": "film", "values": values, "tracks": tracks, **({"drive": drive} if drive else {})}
        ],
        "search": SMALL,
    }
