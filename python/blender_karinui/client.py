"""A program's hold on one document, through `karinui serve` (docs/format/serve.md). Standard library only.

    with Karinui("coat.karinui") as coat:
        coat.ask("perform", operation="sew a=front.side_left b=back.side_left")
        print(coat.ask("settle", told=print)["why"])
"""
import json
import os
import queue
import subprocess
import threading


class Refused(Exception):
    """What cannot be done, as a sentence for a person. It has changed nothing."""

    def __init__(self, pattern, *values):
        super().__init__(pattern.format(*values) if values else pattern)
        self.pattern, self.values = pattern, values  # of a sentence of this file, to be said in another language


class Karinui:
    """One document, open in a child process that ends with this object. One thread at a time."""

    def __init__(self, document, command="karinui", language=None):
        environment = dict(os.environ)
        if language:
            environment["LC_ALL"] = language
        try:
            self._child = subprocess.Popen([command, "serve"], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                           env=environment, encoding="utf-8", errors="replace", bufsize=1)
        except OSError as why:
            raise Refused("“{0}” could not be started: {1}.", command, why.strerror) from why
        self._answers = queue.Queue()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()
        self._asked = 0
        try:
            self.opened = self.ask("open", file=str(document))
        except Refused:
            self.close()
            raise

    def _read(self):
        for line in self._child.stdout:
            try:
                self._answers.put(json.loads(line))
            except ValueError:
                break
        self._answers.put(None)

    def send(self, what, **fields):
        """Asks without waiting; answer() has what came of it."""
        self._asked += 1
        try:
            self._child.stdin.write(json.dumps({"id": self._asked, "do": what, **fields}) + "\n")
            self._child.stdin.flush()
        except (OSError, ValueError) as why:
            raise Refused("Karinui has ended; open the document again.") from why

    def answer(self, wait=None):
        """The next line: progress, or the answer to the last request. None: nothing came within `wait` seconds."""
        try:
            line = self._answers.get(timeout=wait) if wait else self._answers.get()
        except queue.Empty:
            return None
        if line is None:
            self._answers.put(None)
            raise Refused("Karinui has ended; open the document again.")
        if line.get("id") != self._asked:
            return self.answer(wait)  # of stop
        if "error" in line:
            raise Refused(line["error"])
        return line

    def ask(self, what, told=None, **fields):
        """Asks and waits; told(fraction, doing) is called meanwhile."""
        self.send(what, **fields)
        while True:
            line = self.answer()
            if "progress" not in line:
                return line
            if told:
                told(line["progress"], line["doing"])

    def stop(self):
        """Ends the drape under way where the cloth is; its answer still comes."""
        try:
            self._child.stdin.write('{"do": "stop"}\n')
            self._child.stdin.flush()
        except (OSError, ValueError):
            pass  # it has ended; answer() says so

    @property
    def alive(self):
        return self._child.poll() is None

    def close(self):
        """Each step is in the file already."""
        try:
            self._child.stdin.close()
        except OSError:
            pass
        try:
            self._child.wait(10)
        except subprocess.TimeoutExpired:
            self._child.kill()
            self._child.wait()
        self._reader.join()
        self._child.stdout.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
