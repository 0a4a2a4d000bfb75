"""The public names of the core and the packages they are in."""

__version__: str

from .bearings import (
    Bearing as Bearing,
)
from .bearings import (
    CatalogueBearing as CatalogueBearing,
)
from .bearings import (
    Designation as Designation,
)
from .bearings import (
    catalogue as catalogue,
)
from .bearings import (
    read_catalogue as read_catalogue,
)
from .bearings import (
    read_designation as read_designation,
)
from .common import (
    ResultTable as ResultTable,
)
from .errors import (
    FieldError as FieldError,
)
from .errors import (
    Status as Status,
)
from .measured.diagnosis import (
    Diagnosis as Diagnosis,
)
from .measured.diagnosis import (
    DiagnosisStatus as DiagnosisStatus,
)
from .measured.diagnosis import (
    PartEvidence as PartEvidence,
)
from .measured.diagnosis import (
    diagnose as diagnose,
)
from .measured.files import (
    Table as Table,
)
from .measured.files import (
    join_tables as join_tables,
)
from .measured.files import (
    read_recording as read_recording,
)
from .measured.files import (
    read_table as read_table,
)
from .measured.signals import (
    Indicators as Indicators,
)
from .measured.signals import (
    Kurtogram as Kurtogram,
)
from .measured.signals import (
    Spectrogram as Spectrogram,
)
from .measured.signals import (
    indicators as indicators,
)
from .measured.signals import (
    kurtogram as kurtogram,
)
from .measured.signals import (
    order_map as order_map,
)
from .measured.signals import (
    severity_zone as severity_zone,
)
from .measured.signals import (
    spectrogram as spectrogram,
)
from .model import (
    warm as warm,
)
from .model.dynamics import (
    Modes as Modes,
)
from .model.dynamics import (
    Motion as Motion,
)
from .model.dynamics import (
    MotionStatus as MotionStatus,
)
from .model.dynamics import (
    Orbit as Orbit,
)
from .model.dynamics import (
    OrbitStatus as OrbitStatus,
)
from .model.dynamics import (
    SpeedRun as SpeedRun,
)
from .model.dynamics import (
    contact_damping as contact_damping,
)
from .model.dynamics import (
    frequency_bands as frequency_bands,
)
from .model.dynamics import (
    modes as modes,
)
from .model.dynamics import (
    orbit as orbit,
)
from .model.dynamics import (
    simulate as simulate,
)
from .model.dynamics import (
    simulated_record as simulated_record,
)
from .model.dynamics import (
    speed_run as speed_run,
)
from .model.dynamics import (
    to_ross as to_ross,
)
from .model.experiments import (
    Measurements as Measurements,
)
from .model.experiments import (
    alternatives as alternatives,
)
from .model.experiments import (
    measure as measure,
)
from .model.scene import (
    CONTACT_LAWS as CONTACT_LAWS,
)
from .model.scene import (
    DOF_NAMES as DOF_NAMES,
)
from .model.scene import (
    EDGES as EDGES,
)
from .model.scene import (
    RACES as RACES,
)
from .model.scene import (
    Defect as Defect,
)
from .model.scene import (
    Load as Load,
)
from .model.scene import (
    MeasuredFloor as MeasuredFloor,
)
from .model.scene import (
    RoughFloor as RoughFloor,
)
from .model.scene import (
    Scene as Scene,
)
from .model.scene import (
    Support as Support,
)
from .model.scene import (
    preset_notes as preset_notes,
)
from .model.scene import (
    presets as presets,
)
from .model.statics import (
    STIFFNESS_TERMS as STIFFNESS_TERMS,
)
from .model.statics import (
    BallPositions as BallPositions,
)
from .model.statics import (
    ContactPressures as ContactPressures,
)
from .model.statics import (
    Equilibrium as Equilibrium,
)
from .model.statics import (
    Film as Film,
)
from .model.statics import (
    Life as Life,
)
from .model.statics import (
    Limit as Limit,
)
from .model.statics import (
    Maps as Maps,
)
from .model.statics import (
    ball_positions as ball_positions,
)
from .model.statics import (
    contact_pressures as contact_pressures,
)
from .model.statics import (
    dynamic_load_rating as dynamic_load_rating,
)
from .model.statics import (
    equilibrium as equilibrium,
)
from .model.statics import (
    film as film,
)
from .model.statics import (
    life as life,
)
from .model.statics import (
    limits as limits,
)
from .model.statics import (
    scene_of as scene_of,
)
from .model.statics import (
    static_state as static_state,
)
from .model.statics import (
    stiffness_maps as stiffness_maps,
)
from .model.sweeps import (
    OUTPUTS as OUTPUTS,
)
from .model.sweeps import (
    Settings as Settings,
)
from .model.sweeps import (
    SweepStatus as SweepStatus,
)
from .model.sweeps import (
    sweep as sweep,
)
from .recordings import (
    Recording as Recording,
)
from .recordings import (
    Spectrum as Spectrum,
)
from .recordings import (
    envelope_spectrum as envelope_spectrum,
)
from .recordings import (
    spectrum as spectrum,
)
from .sizing import (
    Candidate as Candidate,
)
from .sizing import (
    ExtentStatus as ExtentStatus,
)
from .sizing import (
    MeasuredExtent as MeasuredExtent,
)
from .sizing import (
    Sizing as Sizing,
)
from .sizing import (
    Trend as Trend,
)
from .sizing import (
    TrendPoint as TrendPoint,
)
from .sizing import (
    measure_extent as measure_extent,
)
from .sizing import (
    read_floor as read_floor,
)
from .sizing import (
    size_defect as size_defect,
)
from .sizing import (
    trend as trend,
)
from .sizing import (
    trend_point as trend_point,
)
