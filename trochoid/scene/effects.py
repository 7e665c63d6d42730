"""[[effects]]: the physics that is in the equations; what is not listed is not there and costs nothing."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias, get_args

from pydantic import Field

from trochoid.scene.fields import Coefficient, Table


class ElasticContact(Table):
    """Discs deform where they touch pins, rollers and bearing."""

    type: Literal["elastic_contact"]


class PinCompliance(Table):
    """Ring pins and output pins deform too."""

    type: Literal["pin_compliance"]


class Clearance(Table):
    """Play of pins, holes and bearing, and the modification of the flank."""

    type: Literal["clearance"]


class BearingCompliance(Table):
    """Bearings deform, and with them what stands on them moves."""

    type: Literal["bearing_compliance"]


class PositionErrors(Table):
    """Planets stand off their places by the errors of the scene."""

    type: Literal["position_errors"]


class InertiaForces(Table):
    """Inertia forces of the moving members."""

    type: Literal["inertia"]


class CasingOnMounts(Table):
    """The casing moves on its mounts."""

    type: Literal["casing_on_mounts"]


class Friction(Table):
    """Coulomb friction where flanks slide on ring pins, holes on output rollers and teeth on teeth; rolling bearings
    have none. A kind of drive has the coefficients of its own contacts only (needs.FRICTION_OF).

    Each coefficient is the tangential over the normal force at the outside of pin or roller, where it stands still
    as well as where it turns: μ for a pin that is held, μ·r_bore/r_outside for a sleeve that slides on its pin.
    """

    type: Literal["friction"]
    ring_pins: Coefficient = 0.05
    output_pins: Coefficient = 0.05
    teeth: Coefficient = 0.05


class TimeVaryingStiffness(Table):
    """The stiffness of the contacts varies with the input angle, in torsional vibration."""

    type: Literal["time_varying_stiffness"]


class Backlash(Table):
    """Contacts may leave each other and cross their play, in torsional vibration."""

    type: Literal["backlash"]


AnyEffect: TypeAlias = (
    ElasticContact
    | PinCompliance
    | Clearance
    | BearingCompliance
    | PositionErrors
    | InertiaForces
    | CasingOnMounts
    | Friction
    | TimeVaryingStiffness
    | Backlash
)
Effect: TypeAlias = Annotated[AnyEffect, Field(discriminator="type")]
EFFECTS: tuple[str, ...] = tuple(
    get_args(kind.model_fields["type"].annotation)[0] for kind in get_args(AnyEffect)
)
