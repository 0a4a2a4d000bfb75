"""The records to try on the Diagnosis tab, made by closed forms: `motor_signals` says how.

python -m tests.outside.sample_records
"""

from pathlib import Path

from tests.outside.motor_signals import Motor

FOLDER = Path(__file__).resolve().parents[2] / "assets" / "samples"
MOTORS = {
    "motor-a.csv": Motor(1772.0, "inner race", 0.7, slip=-0.006, duration=2.0),
    "motor-b.csv": Motor(1772.0, hum=((100.0, 0.6), (50.0, 0.4)), duration=2.0),
}
"""Of each file, the motor: one whose inner race is damaged, and a sound one that hums."""


def text_of(name: str, seed: int = 1) -> str:
    """Return the text of a file."""
    motor = MOTORS[name]
    head = (
        "Simulated by closed forms, not measured: a motor on a bearing 6205",
        "Bearing: 6205",
        f"Speed: {motor.rpm:g} rpm",
        f"Sample rate: {motor.rate:g} Hz",
        "y (m/s²)",
    )
    return "\n".join([*head, *(f"{value:.2f}" for value in motor.signal(seed)), ""])


if __name__ == "__main__":
    FOLDER.mkdir(exist_ok=True)
    for name in MOTORS:
        (FOLDER / name).write_text(text_of(name), encoding="utf-8")
