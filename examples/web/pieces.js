// Pieces that fingers drag. All places and sizes are shares of the table: x to the right, y down, 0 to 1.

const colours = ["#e4572e", "#f3a712", "#a8c686", "#4f9d69", "#669bbc", "#4062bb", "#8f5ea8", "#d96c9f"];

/** Four columns of three; the last in the list lies on top. */
export function twelvePieces() {
  const pieces = [];
  for (let i = 0; i < 12; ++i) {
    pieces.push({ name: `piece-${i}`, colour: colours[i % colours.length], width: 0.15, height: 0.2,
                  x: 0.2 + 0.2 * (i % 4), y: 0.22 + 0.28 * Math.floor(i / 4) });
  }
  return pieces;
}

export class Pieces {
  constructor(pieces) {
    this.pieces = pieces;
    this.grips = new Map();  // of fingers, by their id
  }

  /** A finger takes the topmost piece under it, unless another finger has it. */
  down(id, x, y) {
    const piece = this.pieces.findLast((each) =>
      Math.abs(x - each.x) <= each.width / 2 && Math.abs(y - each.y) <= each.height / 2);
    if (piece === undefined || this.isHeld(piece)) return;
    this.pieces.push(...this.pieces.splice(this.pieces.indexOf(piece), 1));
    this.grips.set(id, { piece, dx: piece.x - x, dy: piece.y - y });
  }

  move(id, x, y) {
    const grip = this.grips.get(id);
    if (grip === undefined) return;
    grip.piece.x = x + grip.dx;
    grip.piece.y = y + grip.dy;
  }

  up(id) { this.grips.delete(id); }

  isHeld(piece) { return [...this.grips.values()].some((grip) => grip.piece === piece); }
}
