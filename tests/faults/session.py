"""A session of somebody's that stays open, as the workers see it."""

import subprocess


class Session:
    """psql that waits for the next command; ends its transaction when it goes."""

    END = "-- done --"

    def __init__(self, conninfo):
        self.psql = subprocess.Popen(
            ["psql", "--no-psqlrc", "--quiet", "--no-align", "--tuples-only", "--set", "ON_ERROR_STOP=1",
             conninfo], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.psql.stdin.close()
        self.psql.wait(timeout=30)

    def run(self, command):
        """What psql prints. RuntimeError with its words when the command fails."""
        self.psql.stdin.write(f"{command};\n\\echo '{self.END}'\n")
        self.psql.stdin.flush()
        lines = []
        for line in self.psql.stdout:
            if line.strip() == self.END:
                return "".join(lines).strip()
            lines.append(line)
        raise RuntimeError(f"{command}\n{''.join(lines)}")
