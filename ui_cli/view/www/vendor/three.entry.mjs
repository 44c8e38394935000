export {
  WebGLRenderer, Scene, PerspectiveCamera, OrthographicCamera, Color, Fog, Group, Object3D, Mesh, Vector3, Matrix4, Quaternion, Euler,
  Box3, BoxGeometry, CylinderGeometry, CapsuleGeometry, SphereGeometry, PlaneGeometry, CircleGeometry, BufferGeometry, BufferAttribute,
  Float32BufferAttribute, EdgesGeometry, MeshStandardMaterial, MeshBasicMaterial, ShadowMaterial, LineBasicMaterial, LineSegments, Line,
  DirectionalLight, HemisphereLight, AmbientLight, GridHelper, AxesHelper, ArrowHelper, CanvasTexture, PCFSoftShadowMap, PCFShadowMap,
  ACESFilmicToneMapping, NeutralToneMapping, SRGBColorSpace, DoubleSide, DynamicDrawUsage, Raycaster, Vector2, Sprite, SpriteMaterial,
} from 'three';
export { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
export { RoundedBoxGeometry } from 'three/examples/jsm/geometries/RoundedBoxGeometry.js';
