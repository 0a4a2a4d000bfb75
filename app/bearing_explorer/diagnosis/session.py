"""The measured signal of a session: an uploaded file, or a simulated measurement.

`SignalForm` holds the signal and the answers of a person, and computes in the background;
`Measurement` here adds uploads and simulations. `reading` reads a file, `simulated` makes a signal,
and `measurement_state` has the words that are shown. None of them uses Panel or draws. A file
arrives in pieces, is read in a thread of its own, and opens a form with questions. If it cannot be
read, a sentence says why, and the previous signal stays.
"""

from __future__ import annotations

from collections.abc import Callable, Generator
from dataclasses import replace

from bearing_explorer.diagnosis.measurement_state import MeasurementState
from bearing_explorer.diagnosis.reading import Arrival, read_files
from bearing_explorer.diagnosis.series import MOST_FILES, Series, SeriesRecordings, recordings_of
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.diagnosis.signal_form import SignalForm
from bearing_explorer.diagnosis.simulated import simulated
from bearing_explorer.diagnosis.upload import Upload, first_lines
from bearing_explorer.kit.assets import asset_path
from bearing_explorer.kit.compute.jobs import READING, Change, Jobs, Work
from bearing_explorer.kit.simulated_signals import NOISES
from bearingcore import Scene

RECORDS = {"motor-a.csv": "Motor A", "motor-b.csv": "Motor B"}
"""Records that come with the program, and their names; another program made them in closed form."""


class Measurement(SignalForm):
    """The measurement of one session: its files come in, or the scene is measured.

    Call its methods on the event loop of the session. See `SignalForm` for the parameters.
    """

    #: asks the browser for the piece of a file that begins at a byte; the number of the upload
    #: comes back with the piece
    want: Callable[[int, int], None] = staticmethod(lambda begin, of: None)
    #: called when the next of several files may come
    more: Callable[[], None] = staticmethod(lambda: None)
    _upload: Upload | None = None
    _uploads = _simulations = 0

    def stop(self) -> None:
        super().stop()
        self._upload = None

    # Files

    def begin_upload(
        self,
        name: str,
        size: int,
        number: int = 1,
        count: int = 1,
        chosen: int = 1,
    ) -> None:
        """Begin an upload of `size` bytes, the `number`th of `count`; see `UploadBegins`.

        Of several files, the newest that can be read is shown.
        """
        if self._ended:
            return
        if number == 1:
            self._jobs.drop(READING)
            # a single file joins the series of the files before it
            several = 1 < count <= MOST_FILES
            series = Series(together=True) if several else replace(self.series, together=False)
            self._arrival = Arrival(count if several else 1, chosen, series)
        arrival = self._arrival
        if arrival is None or number not in (1, arrival.number + 1):
            return  # it belongs to an upload that was cancelled
        self._uploads += 1
        arrival.number = number
        try:
            self._upload = Upload(name, size)
        except ValueError as error:
            self._upload = None
            arrival.take(name, str(error))
            self._take_next(arrival)
        else:
            words = f"Uploading {arrival.words}{self._upload.name} …"
            self._update(words=words, bad=False, busy=True)
            self.want(0, self._uploads)

    def cancel(self) -> None:
        """Give up the files that are being uploaded or read; the previous signal stays."""
        self._jobs.drop(READING)
        self._uploads += 1
        self._upload = self._arrival = None
        self._update(words=f"Cancelled.{self._what_stays()}", bad=False, busy=False)

    def take_piece(self, content: bytes, of: int) -> None:
        """Take a piece of the upload with the number `of`."""
        upload, arrival = self._upload, self._arrival
        if upload is None or arrival is None or of != self._uploads:
            return
        try:
            upload.take(content)
        except ValueError as error:
            self._upload = None
            arrival.take(upload.name, str(error))
            self._take_next(arrival)
            return
        if not upload.whole:
            self.want(len(upload.content), self._uploads)
            return
        self._upload = None
        self._read_content(upload.name, bytes(upload.content), arrival)

    def open_record(self, name: str) -> None:
        """Read one of RECORDS, as if it had been uploaded."""
        if self._ended or name not in RECORDS:
            return
        self.cancel()
        self._arrival = Arrival(1, 1, replace(self.series, together=False), number=1)
        self._read_content(name, asset_path(f"samples/{name}").read_bytes(), self._arrival)

    def _read_content(self, file: str, content: bytes, arrival: Arrival) -> None:
        self._update(words=f"Reading {arrival.words}{file} …", bad=False, busy=True)
        scene, kept = self._scene, self._given_machine
        arrival.lines = first_lines(content) if arrival.count == 1 else ""

        def read(work: Work) -> Generator[None, None, str]:
            for name, read, count in read_files(file, content, scene, kept, work.cancelled):
                arrival.take(name, read, count)
                yield
            work.show(arrival)
            return ""

        self._read(read, self._take_next)

    def _take_next(self, arrival: Arrival) -> None:
        """Ask for the next file; after the last one, show the newest file that could be read."""
        if arrival.number < arrival.count:
            self.more()
            return
        self._arrival = None
        if arrival.newest is None:
            none = f"None of {arrival.count} files can be read. "
            self._refuse(f"{none if arrival.count > 1 else ''}{arrival.why}", arrival.lines)
            return
        self.series = arrival.series
        self._take_read(replace(arrival.newest, cut=arrival.notes))

    def recordings(self, shown: Measured, direction: str) -> SeriesRecordings:
        """Return the recordings of the series. For any thread."""
        changed = {name: text for name, text in self._changed.items() if name not in self._kept}
        return recordings_of(self.series, shown, changed, self._kept, direction, self._scene)

    # Simulated signals

    def simulate(self, noise: str) -> None:
        """Simulate a measurement of the scene; `noise` is a key of NOISES."""
        if self._ended or noise not in NOISES:
            return
        self._upload = self._arrival = None
        self._simulations += 1
        seed, scene = self._simulations, self._scene_now()
        self._update(words="Simulating a measurement.", bad=False, busy=True)

        def make(work: Work) -> str:
            work.show(simulated(scene, NOISES[noise], seed))
            return ""

        self._read(make, self._take_simulated)

    def _take_simulated(self, measured: Measured) -> None:
        self._table, self._cut, self.measured = None, "", measured
        self.state = MeasurementState(arrival=self.state.arrival + 1)
        self._update(words=self._summary(), **self._in_short({}))
        self._draw()


def measurement_of(measured: Measured | None, scene: Scene) -> Measurement:
    """Return a measurement outside of a session, with a signal or without one."""

    async def assign(change: Change) -> None:
        change()

    measurement = Measurement(lambda: scene, Jobs(assign), lambda: None)
    measurement.measured = measured
    return measurement
