"""What `requirements-core.txt` is enough for: `python core_alone.py`, in a folder for its files."""

import numpy as np
from scipy.io import savemat

from bearingcore import Scene, diagnose, equilibrium, life, presets, scene_of
from bearingcore.errors import FieldError


def main() -> None:
    """Statics, life, a scene's file, diagnosis; a file that needs pandas is read or refused."""
    scene = presets["fan-rig"].replace(extent=0.2)
    state = equilibrium(scene, np.linspace(0.0, 0.4, 9))
    assert state.converged.all()
    assert "k_yy" in f"{state}{state._repr_html_()}"
    assert life(scene_of("6208").replace(fy=-2000.0)).hours > 1000.0
    assert Scene.from_toml(scene.to_toml()) == scene
    noise = np.random.default_rng(5).standard_normal((12_000, 1))
    savemat("105.mat", {"X105_DE_time": noise, "X105RPM": 1797})
    assert "No clear result" in diagnose("105.mat", "6205").sentence
    with open("signal.csv", "w") as file:
        file.writelines(f"{k / 12e3},{value}\n" for k, value in enumerate(noise[:, 0]))
    try:
        print(diagnose("signal.csv", "6205", 180.0).sentence)
    except FieldError as error:
        print(error)


if __name__ == "__main__":
    main()
