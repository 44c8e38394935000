// Pictures: of the cameras while a task runs, of the run folder afterwards.

const kShortest = 100;  // between two pictures of a camera [ms]

export class Pictures {
  constructor(place, dialog) {
    Object.assign(this, {place, dialog, cameras: new Map()});
    dialog.onclick = () => dialog.close();
  }
  reset() { this.cameras.clear(); this.files = ''; this.place.replaceChildren(); }
  add(caption) {
    const figure = document.createElement('figure'), image = document.createElement('img'), text = document.createElement('figcaption');
    image.alt = text.textContent = caption;
    image.onclick = () => {
      this.dialog.querySelector('img').src = image.src;
      this.dialog.showModal();
    };
    figure.append(image, text);
    this.place.append(figure);
    return {image, text, figure};
  }
  /** @param now  [ms] */
  show(history, now) {
    const files = history.values.pictures || history.scene.pictures || [];
    if (files.length && this.files !== files.join()) this.show_files(files);
    if (history.scene.source !== 'live' || files.length) return;
    for (const [name, number] of Object.entries(history.values.frames || {})) {
      const camera = this.cameras.get(name) || Object.assign(this.add(name), {at: 0, number: -1});
      this.cameras.set(name, camera);
      if (camera.loading || camera.number === number || now - camera.at < kShortest) continue;
      Object.assign(camera, {loading: true, number, at: now});
      camera.image.onload = () => { camera.loading = false; camera.text.textContent = `${name}, picture ${number}`; };
      camera.image.onerror = () => { camera.loading = false; camera.at = now + 2000; camera.text.textContent = `${name}: no pictures; they need --view`; };
      camera.image.src = `api/camera/${encodeURIComponent(name)}.bmp?number=${number}`;
    }
  }
  show_files(files) {
    this.reset();
    this.files = files.join();
    for (const file of files) this.add(file.replace(/^plots\//, '').replace(/\.png$/, '')).image.src = `api/picture/${file.split('/').map(encodeURIComponent).join('/')}`;
  }
}
