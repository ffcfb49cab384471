"""Film of the replay of a run, or of several runs over each other: the drawing of their page, frame by frame.

`sinew film` runs this file as a program, `python3 _film.py FILE RUN... [OPTIONS] <PAGE`, and needs no other part of
the package; `sinew.film` calls it. Chromium, without a window, draws the frames in the page, whose script film.js
also makes a GIF; ffmpeg makes MP4 and WebM. The same page gives the same bytes with the same browser, fonts and ffmpeg.
"""

import argparse
import base64
import json
import math
import os
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any, Callable, Dict, Iterator, List, NamedTuple, NoReturn, Optional, Sequence, Tuple, Union

_Path = Union[str, "os.PathLike[str]"]

_BROWSERS = ["chromium-headless-shell", "chromium", "chromium-browser", "google-chrome", "google-chrome-stable"]
_PATIENCE = 60  # for a reply of the browser, on a slow computer [s]
# Its options. Letters are drawn alike on every screen.
_BROWSER_OPTIONS = """headless remote-debugging-pipe no-first-run disable-gpu disable-dev-shm-usage
    disable-background-networking disable-extensions disable-lcd-text font-render-hinting=none
    force-color-profile=srgb force-device-scale-factor=1 window-size=1280,800""".split()
# One thread and no dates: the same frames give the same bytes.
_FFMPEG = "ffmpeg -hide_banner -loglevel error -y -f image2pipe -c:v png -framerate {fps} -i pipe:0 -pix_fmt yuv420p"
_FFMPEG += " -threads 1 -map_metadata -1 -fflags +bitexact -flags:v +bitexact "
_VIDEOS = {
    ".mp4": _FFMPEG + "-c:v libx264 -crf 18 -movflags +faststart -f mp4",
    ".webm": _FFMPEG + "-c:v libvpx-vp9 -crf 24 -b:v 0 -cpu-used 4 -f webm",
}


class Options(NamedTuple):
    """Content of a film, and its form."""

    start: float = -math.inf  # the part that is shown, in the run's time [s]
    stop: float = math.inf
    speed: float = 1.0  # seconds of the run in one of the film
    width: int = 880  # [pixels]
    height: int = 470
    fps: int = 25
    dark: bool = False
    still: bool = False  # the camera does not move, and shows the whole track


class Refusal(ValueError):
    """Options or runs without a film: the name of what is wrong, what was found and expected, and what to try."""

    def __str__(self) -> str:
        name, found, expected, *hint = self.args
        return f"{name}: found {found}; expected {expected}" + (f"; try {hint[0]}" if hint else "")


class NoDrawing(Refusal):
    """A run whose page has no drawing; its name is the run's."""


def check(file: _Path, options: Options) -> None:
    """Raise Refusal for options that a file with this ending cannot have."""
    kind = Path(file).suffix
    if kind != ".gif" and kind not in _VIDEOS:
        gif = Path(file).with_suffix(".gif")
        raise Refusal("output", f'"{file}"', "a file that ends with .gif, .mp4 or .webm", f'"{gif}"')
    for name in ("width", "height", "fps"):
        number = getattr(options, name)
        if isinstance(number, float) and not number.is_integer():
            raise Refusal(name, number, "a whole number")
    for name, pixels in (("width", options.width), ("height", options.height)):
        if not 100 <= pixels <= 3840:
            raise Refusal(name, pixels, "100 to 3840 pixels")
        if kind != ".gif" and pixels % 2:
            raise Refusal(name, pixels, "an even number of pixels, as MP4 and WebM need")
    # Browsers show a frame of a GIF for two hundredths of a second at least.
    most, word = (50, "GIF") if kind == ".gif" else (120, "video")
    if not 1 <= options.fps <= most:
        raise Refusal("fps", options.fps, f"1 to {most} frames per second, as a {word} shows them")
    if not 1e-3 <= options.speed <= 1000:
        raise Refusal("speed", f"{options.speed:.4g}", "0.001 to 1000 seconds of the run per second")
    if not options.start < options.stop:
        raise Refusal("from", f"{options.start:.4g} s", f"a time before {options.stop:.4g} s")


def browser_file() -> str:
    """Return the file of the browser that draws the frames. Raises RuntimeError if there is no such program."""
    named = os.environ.get("CHROMIUM")
    for name in [named] if named else _BROWSERS:
        file = shutil.which(name)
        if file:
            return file
    if named:
        raise RuntimeError(
            f'CHROMIUM: found "{named}", which is no program; expected the file of Chromium or Chrome, which draws '
            "the frames; try to unset it: then the one on the PATH is used"
        )
    names = ", ".join(_BROWSERS[:-1])
    raise RuntimeError(
        f"no browser that draws the frames is on the PATH, neither {names} nor {_BROWSERS[-1]}; try apt-get install "
        "chromium, or CHROMIUM=FILE in the environment"
    )


def require_programs(file: _Path) -> None:
    """Raise RuntimeError if a program that makes a file with this ending is missing."""
    if Path(file).suffix != ".gif" and not shutil.which("ffmpeg"):
        raise RuntimeError(
            "ffmpeg, which makes MP4 and WebM, is not on the PATH; try apt-get install ffmpeg, or a "
            "film.gif, which needs none"
        )
    browser_file()


def times_of(options: Options, begin: float, end: float) -> List[float]:
    """Return the time of each frame of a run that lasts from `begin` to `end` [s]."""
    start, stop = max(options.start, begin), min(options.stop, end)
    if not start < stop:
        name, found = ("from", options.start) if options.start >= end else ("to", options.stop)
        raise Refusal(name, f"{found:.4g} s", f"a time of the run, {begin:.4g} s to {end:.4g} s")
    step = options.speed / options.fps
    count = max(1, math.floor((stop - start) / step + 1e-6))
    if count > 20000:
        hint = "a shorter time, a higher speed or fewer frames per second"
        raise Refusal("to", f"{count} frames", "20000 at most", hint)
    return [start + i * step for i in range(count)]


def _last_words(file: Path) -> str:
    return "; ".join([line for line in file.read_text(errors="replace").splitlines() if line][-2:])


class _Chromium:
    """A browser that runs JavaScript in a page, over two pipes; it listens on no port and needs no network."""

    def __init__(self, folder: Path) -> None:
        self.program, self.words = browser_file(), folder / "words"
        self.session: Dict[str, str] = {}
        self.number, self.received = 0, b""
        options = [f"--{option}" for option in _BROWSER_OPTIONS] + [f"--user-data-dir={folder / 'profile'}"]
        # The browser does not start its sandbox for root, and the page is one that was made here.
        options += ["--no-sandbox"] if os.geteuid() == 0 else []
        # It reads commands from file 3 and writes into file 4. In its own group, Ctrl-C ends only this program.
        moved = 'exec "$0" "$@" 3<&0 4>&1 </dev/null >&2'
        with self.words.open("wb") as words:
            self.process = subprocess.Popen(
                ["/bin/sh", "-c", moved, self.program, *options, "about:blank"],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=words,
                start_new_session=True,
            )

    def close(self) -> None:
        """End it and what it has started; it ends by itself when its pipe is closed."""
        try:
            self.process.communicate(timeout=3)
        except (subprocess.TimeoutExpired, BrokenPipeError):
            os.killpg(self.process.pid, signal.SIGKILL)
            self.process.wait()

    def fail(self, why: str) -> NoReturn:
        words = _last_words(self.words)
        after = f"; its last words: {words}" if words else ""
        raise RuntimeError(f"the browser that draws the frames, {self.program}, {why}{after}")

    def message(self) -> bytes:
        assert self.process.stdout
        while b"\0" not in self.received:
            if not select.select([self.process.stdout], [], [], _PATIENCE)[0]:
                self.fail("does not reply")
            more = os.read(self.process.stdout.fileno(), 1 << 16)
            if not more:
                self.fail("ended")
            self.received += more
        out, _, self.received = self.received.partition(b"\0")
        return out

    def request(self, method: str, **params: Any) -> Any:
        """Return the result of a command of the browser's developer tools."""
        assert self.process.stdin
        self.number += 1
        command = {"id": self.number, "method": method, "params": params, **self.session}
        try:
            self.process.stdin.write(json.dumps(command).encode() + b"\0")
            self.process.stdin.flush()
        except BrokenPipeError:
            self.fail("ended")
        reply: Dict[str, Any] = {}
        while reply.get("id") != self.number:  # its own messages in between are left out
            reply = json.loads(self.message())
        if "error" in reply:
            self.fail(f"refuses {method}: {reply['error'].get('message', '')}")
        return reply["result"]

    def open(self, page: Path) -> None:
        """Open a page of a run and wait until it has read its samples."""
        target = self.request("Target.createTarget", url=page.as_uri())["targetId"]
        attached = self.request("Target.attachToTarget", targetId=target, flatten=True)
        self.session = {"sessionId": attached["sessionId"]}
        end = time.monotonic() + 120
        while self.evaluate("document.documentElement?.dataset.ready ?? ''") != "yes":
            failed = self.evaluate("document.querySelector('.failed')?.textContent ?? ''")
            if failed or time.monotonic() > end:
                raise RuntimeError(failed or "the run's page was not ready within two minutes")
            time.sleep(0.02)

    def evaluate(self, script: str) -> Any:
        """Return the value of a script that runs in the page, or of its promise."""
        reply = self.request("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True)
        details = reply.get("exceptionDetails")
        if details:
            words = details.get("exception", {}).get("description", details.get("text", ""))
            raise RuntimeError(f"the run's page met an error: {words}")
        return reply["result"].get("value")


def _gif(browser: _Chromium, times: List[float], fps: int) -> Iterator[bytes]:
    """Yield the bytes that each frame adds to the file, and those of its end."""
    sample = [times[i * len(times) // 12] for i in range(12)]
    browser.evaluate(f"window.film.choose_palette({json.dumps(sample)})")
    # A GIF counts hundredths of a second: rounded so that the film does not drift.
    hundredths = [math.floor(100 * i / fps + 0.5) for i in range(len(times) + 1)]
    for i, t in enumerate(times):
        delay = 10 * (hundredths[i + 1] - hundredths[i])
        yield base64.b64decode(browser.evaluate(f"window.film.gif_frame({t!r}, {delay})"))
    yield base64.b64decode(browser.evaluate("window.film.gif_end()"))


def _video(browser: _Chromium, times: List[float], file: Path, command: str, words: Path) -> Iterator[None]:
    """Write a video, and yield after each frame."""
    with words.open("wb") as log:
        ffmpeg = subprocess.Popen(
            [*command.split(), str(file)], stdin=subprocess.PIPE, stderr=log, start_new_session=True
        )
    assert ffmpeg.stdin
    try:
        for t in times:
            ffmpeg.stdin.write(base64.b64decode(browser.evaluate(f"window.film.png({t!r})")))
            yield
        ffmpeg.stdin.close()
    except BrokenPipeError:
        pass  # it has ended, with a code
    except BaseException:
        ffmpeg.kill()
        ffmpeg.communicate()
        raise
    if ffmpeg.wait() != 0:
        raise RuntimeError(f"{file.with_suffix('')}: ffmpeg could not make it: {_last_words(words)}")


def make(
    page: str,
    runs: Sequence[str],
    file: Path,
    options: Options,
    progress: Callable[[int, int], None] = lambda done, frames: None,
) -> int:
    """Make the film of a page of these runs and return its number of frames.

    An older file is replaced when the new one is complete. Raises Refusal, and RuntimeError where a program is missing.
    """
    check(file, options)
    require_programs(file)
    unfinished = file.with_name(file.name + ".unfinished")
    with tempfile.TemporaryDirectory(prefix="sinew-film-", ignore_cleanup_errors=True) as name:
        folder = Path(name)
        (folder / "run.html").write_text(page, encoding="utf-8")
        browser = _Chromium(folder)
        try:
            browser.open(folder / "run.html")
            drawn = browser.evaluate("window.sinew_drawn()")
            for i, run in enumerate(runs):
                if i not in drawn:
                    expected = "a run of a robot or of the test stand whose file has the places of its parts"
                    raise NoDrawing(run, "a run without a drawing", expected)
            times = times_of(options, *browser.evaluate("window.sinew_span()"))
            form = {"size": [options.width, options.height], "speed": options.speed}
            form.update(dark=options.dark, still=options.still)
            browser.evaluate(f"window.sinew_film({json.dumps(form)})")
            if file.suffix == ".gif":
                with unfinished.open("wb") as out:
                    for done, frame in enumerate(_gif(browser, times, options.fps)):
                        out.write(frame)
                        progress(done, len(times))
            else:
                command = _VIDEOS[file.suffix].format(fps=options.fps)
                for done, _ in enumerate(_video(browser, times, unfinished, command, folder / "video-words")):
                    progress(done + 1, len(times))
            os.replace(unfinished, file)
        finally:
            browser.close()
            unfinished.unlink(missing_ok=True)
    return len(times)


def film(
    runs: Union[_Path, Sequence[_Path]],
    path: _Path,
    *,
    start: Optional[float] = None,
    stop: Optional[float] = None,
    speed: float = 1.0,
    width: int = 880,
    height: int = 470,
    fps: int = 25,
    dark: bool = False,
    still: bool = False,
    align: str = "start",
    fit_clock: bool = False,
    force: bool = False,
) -> int:
    """Make a film of the replay of a run that is kept, or of several over each other: .gif, .mp4 or .webm.

    Of several runs the others are ghosts over the first. `align` aligns these with the first run: start, sequence,
    event or correlation; `fit_clock` takes out their clocks' rates. Chromium draws its frames, ffmpeg makes MP4 and
    WebM of them. `start` and `stop` are in s of the run; `speed` is how many of its seconds one of the film shows;
    `still` keeps the camera in one place. Returns the number of frames. Raises InputError, and RuntimeError where a
    program is missing.
    """
    from sinew._sinew import film_page, refuse

    span = (-math.inf if start is None else start, math.inf if stop is None else stop)
    options = Options(*span, speed, width, height, fps, dark, still)
    names = [os.fspath(run) for run in runs] if isinstance(runs, (list, tuple)) else [os.fspath(runs)]  # type: ignore
    try:
        check(path, options)
        require_programs(path)
        return make(film_page(names, path, align, fit_clock, force), names, Path(path), options)
    except Refusal as why:
        refuse(*map(str, why.args))
        raise  # never reached: refuse() raises InputError


def _arguments() -> Tuple[argparse.Namespace, Options]:
    parser = argparse.ArgumentParser()
    parser.add_argument("file", type=Path)
    parser.add_argument("runs", nargs="+")
    parser.add_argument("--quiet", action="store_true")
    parser.add_argument("--check", action="store_true", help="only check options and programs, without a page")
    for name, default in Options()._asdict().items():
        if isinstance(default, bool):
            parser.add_argument(f"--{name}", action="store_true")
        else:
            parser.add_argument(f"--{name}", type=type(default), default=default)
    given = parser.parse_args()
    return given, Options(**{name: getattr(given, name) for name in Options._fields})


def main() -> int:
    """Make the film that the command line describes; return the exit code."""
    given, options = _arguments()

    def show(done: int, frames: int) -> None:
        if not given.quiet and sys.stderr.isatty():
            end = "\r\033[K" if done == frames else ""
            print(f"\r{done} of {frames} frames{end}", end="", file=sys.stderr, flush=True)

    try:
        if given.check:
            check(given.file, options)
            require_programs(given.file)
            return 0
        frames = make(sys.stdin.buffer.read().decode(), given.runs, given.file, options, show)
    except Refusal as why:
        if not isinstance(why, NoDrawing):
            print(f"--{why}", file=sys.stderr)
            return 2
        print(why, file=sys.stderr)
        return 1
    except (RuntimeError, OSError) as why:
        print(why, file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)
        return 1
    if not given.quiet:
        size = 1e-6 * given.file.stat().st_size
        print(f"{given.file}, {frames} frames, {frames / options.fps:.1f} s, {size:.2f} MB", file=sys.stderr)
    return 0


if __name__ == "__main__":
    # Each of these signals ends a film and removes its files. One that nohup ignores stays ignored.
    for ends in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT):
        if ends == signal.SIGINT or signal.getsignal(ends) != signal.SIG_IGN:
            signal.signal(ends, signal.default_int_handler)
    sys.exit(main())
