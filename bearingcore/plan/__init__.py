"""The cheapest settings that keep a picture inside an error budget."""

from bearingcore.plan.cage_angles import CURVES
from bearingcore.plan.choose import plan
from bearingcore.plan.plans import BUDGETS, SETTLED, VIBRATION, VIEWS, Offer, Plan

__all__ = ["BUDGETS", "CURVES", "SETTLED", "VIBRATION", "VIEWS", "Offer", "Plan", "plan"]
