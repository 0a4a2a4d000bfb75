"""Public names of the core and the packages that hold them."""

__version__: str

from .bearings import (
    Bearing as Bearing,
    CatalogueBearing as CatalogueBearing,
    Designation as Designation,
    catalogue as catalogue,
    read_catalogue as read_catalogue,
    read_designation as read_designation,
)
from .common import ResultTable as ResultTable
from .errors import FieldError as FieldError, Status as Status
from .measured.diagnosis import (
    Diagnosis as Diagnosis,
    DiagnosisStatus as DiagnosisStatus,
    PartEvidence as PartEvidence,
    diagnose as diagnose,
)
from .measured.files import (
    Table as Table,
    join_tables as join_tables,
    read_recording as read_recording,
    read_table as read_table,
)
from .measured.signals import (
    Indicators as Indicators,
    Kurtogram as Kurtogram,
    Spectrogram as Spectrogram,
    indicators as indicators,
    kurtogram as kurtogram,
    order_map as order_map,
    severity_zone as severity_zone,
    spectrogram as spectrogram,
)
from .model import warm as warm
from .model.dynamics import (
    ForceSamples as ForceSamples,
    Modes as Modes,
    Motion as Motion,
    MotionStatus as MotionStatus,
    Orbit as Orbit,
    OrbitStatus as OrbitStatus,
    SpeedRun as SpeedRun,
    contact_damping as contact_damping,
    frequency_bands as frequency_bands,
    modes as modes,
    orbit as orbit,
    simulate as simulate,
    simulated_record as simulated_record,
    speed_run as speed_run,
    to_ross as to_ross,
)
from .model.experiments import (
    Measurements as Measurements,
    alternatives as alternatives,
    measure as measure,
)
from .model.scene import (
    CONTACT_LAWS as CONTACT_LAWS,
    DOF_NAMES as DOF_NAMES,
    EDGES as EDGES,
    RACES as RACES,
    Defect as Defect,
    Load as Load,
    MeasuredFloor as MeasuredFloor,
    RoughFloor as RoughFloor,
    Scene as Scene,
    Support as Support,
    preset_notes as preset_notes,
    presets as presets,
)
from .model.statics import (
    STIFFNESS_TERMS as STIFFNESS_TERMS,
    BallPositions as BallPositions,
    ContactPressures as ContactPressures,
    Equilibrium as Equilibrium,
    Film as Film,
    Life as Life,
    Limit as Limit,
    Maps as Maps,
    ball_positions as ball_positions,
    contact_pressures as contact_pressures,
    dynamic_load_rating as dynamic_load_rating,
    equilibrium as equilibrium,
    film as film,
    life as life,
    limits as limits,
    scene_of as scene_of,
    static_state as static_state,
    stiffness_maps as stiffness_maps,
)
from .model.sweeps import (
    OUTPUTS as OUTPUTS,
    Settings as Settings,
    SweepStatus as SweepStatus,
    sweep as sweep,
)
from .recordings import (
    Recording as Recording,
    Spectrum as Spectrum,
    envelope_spectrum as envelope_spectrum,
    spectrum as spectrum,
)
from .sizing import (
    Candidate as Candidate,
    ExtentStatus as ExtentStatus,
    MeasuredExtent as MeasuredExtent,
    Sizing as Sizing,
    Trend as Trend,
    TrendPoint as TrendPoint,
    measure_extent as measure_extent,
    read_floor as read_floor,
    size_defect as size_defect,
    trend as trend,
    trend_point as trend_point,
)
