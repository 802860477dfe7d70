"""pyserial's example of an RFC 2217 server, in a separate process: one client,
one port that gives back what it is sent.

Prints the number of its TCP port, and each set of line settings it was asked for.
"""

import socket
import sys
import threading

import serial
import serial.rfc2217


class Client:
    """The connection, written to from two threads."""

    def __init__(self, connection: socket.socket) -> None:
        self.connection = connection
        self.lock = threading.Lock()

    def write(self, data: bytes) -> None:
        with self.lock:
            self.connection.sendall(data)


def serve(listening: socket.socket) -> None:
    port = serial.serial_for_url("loop://", timeout=0.02)
    connection, _ = listening.accept()
    client = Client(connection)
    manager = serial.rfc2217.PortManager(port, client)
    over = threading.Event()

    def forward() -> None:
        while not over.is_set():
            data = port.read(port.in_waiting or 1)
            if data:
                client.write(b"".join(manager.escape(data)))

    reader = threading.Thread(target=forward)
    reader.start()
    while data := connection.recv(1024):
        port.write(b"".join(manager.filter(data)))
    over.set()
    reader.join()
    print(port.baudrate, port.bytesize, port.parity, port.stopbits, port.xonxoff, port.rtscts, flush=True)


if __name__ == "__main__":
    with socket.create_server(("127.0.0.1", 0)) as listening:
        print(listening.getsockname()[1], flush=True)
        for _ in range(int(sys.argv[1])):
            serve(listening)
