"""Files as programs write them, without a disk."""

import io
import zipfile
from collections.abc import Callable

from scipy.io import savemat


def saved(write: Callable[..., object], *what: object, **options: object) -> bytes:
    """What a function writes into the file it is given first."""
    file = io.BytesIO()
    write(file, *what, **options)
    return file.getvalue()


def matlab(**variables: object) -> bytes:
    return saved(savemat, variables)


def zipped(**files: bytes) -> bytes:
    """Files by name, in which `_` stands for a dot and `-` for `_`."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as made:
        for name, content in files.items():
            made.writestr(name.replace("_", ".").replace("-", "_"), content)
    return file.getvalue()
