// SPDX-License-Identifier: Apache-2.0
// What is drawn, by vtk.js: two actors a body, its surface and what a cut lays open, and lines.

// What of WebGL is needed; the profiles bring axes, scalar bars and more.
import "@kitware/vtk.js/Rendering/OpenGL/Actor";
import "@kitware/vtk.js/Rendering/OpenGL/Camera";
import "@kitware/vtk.js/Rendering/OpenGL/PolyDataMapper";
import "@kitware/vtk.js/Rendering/OpenGL/Renderer";
import vtkDataArray from "@kitware/vtk.js/Common/Core/DataArray";
import vtkPolyData from "@kitware/vtk.js/Common/DataModel/PolyData";
import vtkActor from "@kitware/vtk.js/Rendering/Core/Actor";
import vtkMapper from "@kitware/vtk.js/Rendering/Core/Mapper";
import vtkRenderer from "@kitware/vtk.js/Rendering/Core/Renderer";
import vtkRenderWindow from "@kitware/vtk.js/Rendering/Core/RenderWindow";
import vtkOpenGLRenderWindow from "@kitware/vtk.js/Rendering/OpenGL/RenderWindow";

import type { Drawn } from "./cut";
import type { Rgb } from "./paint";

type Actor = ReturnType<typeof vtkActor.newInstance>;
type Camera = ReturnType<ReturnType<typeof vtkRenderer.newInstance>["getActiveCamera"]>;

function share(colour: Rgb): [number, number, number] {
  return [colour[0] / 255, colour[1] / 255, colour[2] / 255];
}

/** Triangles or lines of one colour or of many. */
export class Piece {
  readonly actor: Actor = vtkActor.newInstance();
  private readonly mapper = vtkMapper.newInstance();

  constructor(private readonly colour: Rgb) {
    this.mapper.setScalarModeToUseCellData();
    this.mapper.setColorModeToDirectScalars();
    this.actor.setMapper(this.mapper);
    const property = this.actor.getProperty();
    property.setColor(...share(colour));
    property.setInterpolationToFlat();
    property.setAmbient(0.18);
    property.setDiffuse(0.82);
    property.setSpecular(0);
    property.setEdgeColor(0.1, 0.1, 0.12);
    property.setLineWidth(1);
  }

  /** `colours`: three bytes a triangle; null: the piece's own. */
  show(points: Float32Array, drawn: Drawn, colours: Uint8Array | null): void {
    const count = drawn.owners.length;
    const cells = new Uint32Array(4 * count);
    for (let f = 0; f < count; ++f) {
      cells[4 * f] = 3;
      for (let i = 0; i < 3; ++i) cells[4 * f + 1 + i] = drawn.triangles[3 * f + i]!;
    }
    const data = vtkPolyData.newInstance();
    data.getPoints().setData(points, 3);
    data.getPolys().setData(cells);
    if (colours)
      data
        .getCellData()
        .setScalars(
          vtkDataArray.newInstance({ name: "colours", numberOfComponents: 3, values: colours }),
        );
    this.mapper.setScalarVisibility(colours !== null);
    this.mapper.setInputData(data);
  }

  /** Lines, six numbers each: from here to there. */
  showLines(ends: Float32Array): void {
    const count = ends.length / 6;
    const cells = new Uint32Array(3 * count);
    for (let l = 0; l < count; ++l) cells.set([2, 2 * l, 2 * l + 1], 3 * l);
    const data = vtkPolyData.newInstance();
    data.getPoints().setData(ends, 3);
    data.getLines().setData(cells);
    this.mapper.setScalarVisibility(false);
    this.mapper.setInputData(data);
    const property = this.actor.getProperty();
    property.setLighting(false);
    property.setColor(...share(this.colour));
    this.actor.setVisibility(count > 0);
  }
}

export class Stage {
  readonly renderer = vtkRenderer.newInstance();
  readonly canvas: HTMLCanvasElement;
  private readonly window = vtkRenderWindow.newInstance();
  private readonly view = vtkOpenGLRenderWindow.newInstance();
  private waiting = false;
  /** Called before and after each picture. */
  beforeDrawing: () => void = () => {};
  afterDrawing: () => void = () => {};

  constructor(private readonly frame: HTMLElement) {
    this.window.addRenderer(this.renderer);
    this.window.addView(this.view);
    this.view.setContainer(frame);
    this.canvas = this.view.getCanvas()!;
    this.resize();
    new ResizeObserver(() => this.resize()).observe(frame);
  }

  get camera(): Camera {
    return this.renderer.getActiveCamera();
  }

  get height(): number {
    return this.frame.clientHeight;
  }

  get pixelsPerMm(): number {
    return this.height / (2 * this.camera.getParallelScale());
  }

  /** Width over height. */
  get slimness(): number {
    return this.frame.clientWidth / Math.max(this.frame.clientHeight, 1);
  }

  /** Draws once before the next picture of the browser, however often it is asked. */
  redraw(): void {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.draw();
    });
  }

  draw(): void {
    this.beforeDrawing();
    this.renderer.resetCameraClippingRange();
    this.window.render();
    this.afterDrawing();
  }

  private resize(): void {
    const scale = Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.max(1, Math.round(this.frame.clientWidth * scale));
    const height = Math.max(1, Math.round(this.frame.clientHeight * scale));
    this.view.setSize(width, height);
    this.redraw();
  }
}
