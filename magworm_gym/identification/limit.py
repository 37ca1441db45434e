"""Up to which loss a candidate fits about as well as the best."""

CHI_SQUARE_95 = 3.84
"""95 % quantile of chi-square with one degree of freedom [1]."""

ABOUT = 0.2
"""Part of the least loss that a candidate may be worse by and still fit about as well [1]."""


def threshold(best: float, measurements: float, parameters: int) -> float:
    """Loss up to which a candidate fits about as well as the best.

    best + 3.84 max(1, best / (n − p)): the range of each parameter is then its likelihood interval of
    95 %, with the noise taken from the misfit where that is greater than the tolerances. Where the model
    misses the data, what is a fifth worse does not fit as well, however few the measurements.

    Args:
        best: Least loss [1].
        measurements: Number of independent measurements n [1].
        parameters: Number of parameters p.
    """
    widened = CHI_SQUARE_95 * best / max(measurements - parameters, 1.0)
    return best + max(CHI_SQUARE_95, min(widened, ABOUT * best))
