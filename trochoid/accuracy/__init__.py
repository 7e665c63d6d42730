"""What accuracy costs: error against seconds over the models and mesh levels that a drive offers."""

from trochoid.accuracy.document import to_json
from trochoid.accuracy.measure import BUDGET, study
from trochoid.accuracy.study import Step, Study
from trochoid.accuracy.terminal import show
from trochoid.accuracy.write import write

__all__ = ["BUDGET", "Step", "Study", "show", "study", "to_json", "write"]
