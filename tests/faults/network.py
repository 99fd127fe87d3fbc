"""Network namespaces as hosts: each has one cable to a switch, which can be pulled or made to lose
packets. Nothing outside these namespaces is touched."""

import os
import subprocess

from shell import run

NETWORK = "10.77.0"
# Of the namespaces; the number of the process follows.
PREFIX = "lsf"


class Network:
    def __init__(self, hosts):
        self.prefix = f"{PREFIX}{os.getpid()}"
        self.address = {host: f"{NETWORK}.{number}" for number, host in enumerate(hosts, 1)}
        self.made = []

    def build(self):
        self._make("switch")
        self._ip("switch", "link add bridge type bridge")
        self._ip("switch", "link set bridge up")
        for host in self.address:
            self._connect(host)

    def name(self, host):
        return f"{self.prefix}-{host}"

    def _make(self, host):
        self.made.append(host)
        run(["ip", "netns", "add", self.name(host)])
        self._ip(host, "link set lo up")

    def _ip(self, host, words):
        run(["ip", "-n", self.name(host), *words.split()])

    def _connect(self, host):
        self._make(host)
        self._ip("switch", f"link add {host} type veth peer name cable netns {self.name(host)}")
        self._ip("switch", f"link set {host} master bridge up")
        self._ip(host, f"address add {self.address[host]}/24 dev cable")
        self._ip(host, "link set cable up")

    def inside(self, host):
        """What a command begins with to run on the host."""
        return ["ip", "netns", "exec", self.name(host)]

    def pull_cable(self, host):
        self._ip("switch", f"link set {host} down")

    def plug_cable(self, host):
        self._ip("switch", f"link set {host} up")

    def lose_packets(self, host, percent):
        """In both directions. By nftables: the kernel may have no netem."""
        rules = "".join(
            f" chain {hook} {{\n  type filter hook {hook} priority 0; policy accept;\n"
            f"  {interface} cable numgen random mod 100 < {percent} drop\n }}\n"
            for hook, interface in (("input", "iifname"), ("output", "oifname")))
        run([*self.inside(host), "nft", "-f", "-"], input=f"table inet loss {{\n{rules}}}\n")

    def lose_nothing(self, host):
        run([*self.inside(host), "nft", "flush", "ruleset"])

    def remove(self):
        for host in reversed(self.made):
            subprocess.run(["ip", "netns", "del", self.name(host)], check=False,
                           capture_output=True)
        self.made = []
