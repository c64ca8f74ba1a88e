import { TuioReceiver } from "tuio-client";
import { oscMessages } from "./osc.js";

const retryMs = 500;

/** TUIO by WebSocket. Comes back when the table was away; meanwhile there are no touches. */
export class TableReceiver extends TuioReceiver {
  /** `onState` is told true when the table is there, and false when it is not. */
  constructor(url, onState) {
    super();
    this.url = url;
    this.onState = onState;
  }

  connect() {
    const socket = new WebSocket(this.url);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => this.setConnected(true);
    socket.onmessage = ({ data }) => {
      for (const message of oscMessages(data)) this.onOscMessage(message);
    };
    socket.onclose = () => {
      this.setConnected(false);
      this.liftAll();
      this.retry = setTimeout(() => this.connect(), retryMs);
    };
    this.socket = socket;
  }

  disconnect() {
    clearTimeout(this.retry);
    this.socket.onclose = null;
    this.socket.close();
    this.setConnected(false);
  }

  setConnected(connected) {
    this.isConnected = connected;
    this.onState(connected);
  }

  liftAll() {
    for (const args of [["alive"], ["fseq", -1]]) this.onOscMessage({ address: "/tuio/2Dcur", args });
  }
}
