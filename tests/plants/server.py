"""A throw-away PostgreSQL server and psql on it."""

import os
import subprocess
import tempfile
from pathlib import Path

SOURCE_DIR = Path(__file__).resolve().parents[2]
_SCRIPT = SOURCE_DIR / "tests" / "support" / "postgres"
_ROLES = SOURCE_DIR / "deploy" / "roles.sql"


class Server:
    def __enter__(self):
        handle, self._file = tempfile.mkstemp(prefix="loopscope-plants.", suffix=".env")
        os.close(handle)
        os.unlink(self._file)
        try:
            subprocess.run([_SCRIPT, "start", self._file], check=True, stdout=subprocess.DEVNULL)
            self._conninfo = Path(self._file).read_text(encoding="utf-8").strip().split("=", 1)[1]
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        subprocess.run([_SCRIPT, "stop", self._file], check=False, stdout=subprocess.DEVNULL)

    def conninfo(self, database="postgres", user="postgres"):
        return self._conninfo.replace("dbname=postgres", f"dbname={database}").replace(
            "user=postgres", f"user={user}")

    def make_owner(self, database):
        """The group roles, and a login that may migrate: the program takes no superuser."""
        self.sql(_ROLES.read_text(encoding="utf-8"), database)
        self.sql("DO $$ BEGIN CREATE ROLE test_owner LOGIN IN ROLE loopscope_owner;"
                 " EXCEPTION WHEN duplicate_object THEN NULL; END $$")

    def _psql(self, database):
        return ["psql", "--no-psqlrc", "--quiet", "--set", "ON_ERROR_STOP=1", "--no-align",
                "--tuples-only", "--field-separator", "\t", self.conninfo(database)]

    def sql(self, text, database="postgres"):
        """Runs statements; the rows of the last as lists of texts."""
        done = subprocess.run(self._psql(database), input=text, text=True, capture_output=True,
                              check=False)
        if done.returncode != 0:
            raise RuntimeError(f"psql: {done.stderr.strip()}")
        return [line.split("\t") for line in done.stdout.splitlines() if line]

    def copy(self, command, table, database):
        """What the command prints goes into the table as it comes."""
        with subprocess.Popen(command, stdout=subprocess.PIPE) as source:
            done = subprocess.run([*self._psql(database), "-c", f"\\copy {table} FROM STDIN"],
                                  stdin=source.stdout, text=True, capture_output=True, check=False)
            source.stdout.close()
        if source.returncode != 0 or done.returncode != 0:
            raise RuntimeError(f"{Path(command[0]).name} into {table}: {done.stderr.strip()}")
